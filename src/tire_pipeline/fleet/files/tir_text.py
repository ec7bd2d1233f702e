"""The ``.tir`` text of a measurement, in each manufacturer's own style."""

from __future__ import annotations

from dataclasses import dataclass

from tire_pipeline.fleet.manufacturer_fits.formula import FITTED_ALIGNING, FITTED_LATERAL, FITTED_LONGITUDINAL
from tire_pipeline.unit_definitions import DEGREE

_COMBINED_X = "RBX1 RBX2 RCX1 REX1 REX2 RHX1".split()
_COMBINED_Y = "RBY1 RBY2 RBY3 RCY1 REY1 REY2 RHY1 RHY2 RVY1 RVY2 RVY3 RVY4 RVY5 RVY6".split()
_WRITTEN_SCALE_FACTORS = (
    "LFZO LCX LMUX LEX LKX LHX LVX LGAX LCY LMUY LEY LKY LHY LVY LGAY "
    "LTR LRES LGAZ LXAL LYKA LVYKA LS LSGKP LSGAL LGYR LMX LVMX LMY"
).split()

# The coefficient sections in file order. Each key is a column of the table of values.
WRITTEN_SECTIONS: dict[str, list[str]] = {
    "LONGITUDINAL_COEFFICIENTS": [*FITTED_LONGITUDINAL, *_COMBINED_X, "PTX1", "PTX2", "PTX3"],
    "OVERTURNING_COEFFICIENTS": ["QSX1", "QSX2", "QSX3"],
    "LATERAL_COEFFICIENTS": [*FITTED_LATERAL, *_COMBINED_Y, "PTY1", "PTY2"],
    "ROLLING_COEFFICIENTS": ["QSY1", "QSY2", "QSY3", "QSY4"],
    "ALIGNING_COEFFICIENTS": [*FITTED_ALIGNING, "SSZ1", "SSZ2", "SSZ3", "SSZ4", "QTZ1", "MBELT"],
}

_REMARKS: dict[str, str] = {
    "PCX1": "Shape factor Cfx for longitudinal force",
    "PDX1": "Longitudinal friction Mux at Fznom",
    "PKX1": "Longitudinal slip stiffness Kfx/Fz at Fznom",
    "PCY1": "Shape factor Cfy for lateral forces",
    "PDY1": "Lateral friction Muy",
    "PDY2": "Variation of friction Muy with load",
    "PDY3": "Variation of friction Muy with squared camber",
    "PEY1": "Lateral curvature Efy at Fznom",
    "PEY2": "Variation of curvature Efy with load",
    "PEY3": "Zero order camber dependency of curvature Efy",
    "PKY1": "Maximum value of stiffness Kfy/Fznom",
    "PKY2": "Load at which Kfy reaches maximum value",
    "PHY1": "Horizontal shift Shy at Fznom",
    "PVY1": "Vertical shift in Svy/Fz at Fznom",
    "QBZ1": "Trail slope factor for trail Bpt at Fznom",
    "QDZ1": "Peak trail Dpt = Dpt*(Fz/Fznom*R0)",
    "QSX1": "Lateral force induced overturning moment",
    "QSY1": "Rolling resistance torque coefficient",
    "FNOMIN": "Nominal wheel load",
    "UNLOADED_RADIUS": "Free tyre radius",
    "WIDTH": "Nominal section width of the tyre",
    "ASPECT_RATIO": "Nominal aspect ratio",
    "RIM_RADIUS": "Nominal rim radius",
    "RIM_WIDTH": "Rim width",
    "LONGVL": "Measurement speed",
    "ALPMIN": "Minimum valid slip angle",
    "ALPMAX": "Maximum valid slip angle",
    "FZMIN": "Minimum allowed wheel load",
    "FZMAX": "Maximum allowed wheel load",
}


@dataclass(frozen=True)
class FileStyle:
    """How a manufacturer writes.

    Attributes
    ----------
    header : tuple of str
        Comment lines at the top; ``%(date)s`` stands for the day of the measurement.
    fittyp : str or None
        Value of ``FITTYP``, or left out.
    number : str
        Format of coefficients.
    newline : str
    millimetres, degrees, bar : bool
        Units other than m, rad, Pa.
    lower_case : bool
        Keys in lower case.
    tabs : bool
        Tabs for alignment.
    comment : str
        ``$`` or ``!``.
    remarks : bool
        A remark behind each key that has one.
    drops_empty : bool
        A coefficient without a value is left out; else its key stands with nothing behind it.
    shape_table : bool
        Writes the rows of ``[SHAPE]``.
    name : str
        File name; ``%d`` is a running number.
    """

    header: tuple[str, ...]
    fittyp: str | None = "52"
    number: str = "%.7g"
    newline: str = "\n"
    millimetres: bool = False
    degrees: bool = False
    bar: bool = False
    lower_case: bool = False
    tabs: bool = False
    comment: str = "$"
    remarks: bool = True
    drops_empty: bool = False
    shape_table: bool = True
    name: str = "tyre_%06d.tir"


FILE_STYLES: dict[str, FileStyle] = {
    "A": FileStyle(
        header=("Flat belt laboratory", "Date of test: %(date)s", "Fit: all coefficients"),
        name="A_%05d.tir",
    ),
    "B": FileStyle(
        header=("DRUM TEST BENCH  2.5 m", "processed %(date)s", 'operator "night shift'),
        newline="\r\n",
        millimetres=True,
        number="%.6f",
        remarks=False,
        name="drum_%05d.tir",
    ),
    "C": FileStyle(
        header=("Measurement %(date)s = belt, one direction",),
        lower_case=True,
        comment="!",
        number="%.8f",
        drops_empty=True,
        shape_table=False,
        name="c%05d_mf52.tir",
    ),
    "D": FileStyle(
        header=("Tyre property file for MF-Tyre 5.2", "Test date %(date)s", "Surface: asphalt replica"),
        fittyp="6",
        number="%.5E",
        name="D-%06d.tir",
    ),
    "E": FileStyle(
        header=("trailer, proving ground, %(date)s",),
        fittyp="21",
        tabs=True,
        bar=True,
        newline="\r\n",
        number="%.7f",
        drops_empty=True,
        name="trailer_%06d.tir",
    ),
    "F": FileStyle(
        header=("internal drum", "DATE : %(date)s"),
        fittyp=None,
        degrees=True,
        remarks=False,
        name="F%04d.tir",
    ),
}
_TINY_STYLES = {"G": "A", "H": "B", "I": "C", "J": "D", "K": "F"}


def style_of(category: str) -> FileStyle:
    """How a category writes; the tiny ones copy a large one's style."""
    return FILE_STYLES[_TINY_STYLES.get(category, category)]


class Template:
    """Text of a file with places for the values, made once a manufacturer.

    Parameters
    ----------
    style : FileStyle
    compound : bool
        Also write ``COMPOUND_CLASS``.
    """

    def __init__(self, style: FileStyle, compound: bool) -> None:
        self.style = style
        self.keys: list[str] = []
        lines = [*(f"{style.comment} {line}" for line in style.header)]
        lines += self._head(compound)
        lines += self._numbers()
        self.text = style.newline.join(lines) + style.newline

    def render(self, values: dict[str, float], words: dict[str, str], without: str = "") -> str:
        """Fill in one file.

        Parameters
        ----------
        values : dict of str to float
            In SI; every key of :attr:`keys`.
        words : dict of str to str
            ``date`` and, if written, ``compound``.
        without : str, optional
            A coefficient that gets no value.

        Returns
        -------
        str
            With the manufacturer's line ends.
        """
        style = self.style
        filled: dict[str, str] = dict(words)
        for key in self.keys:
            filled[key] = self._number(key, values[key])
        if without:
            filled[without] = ""
        text = self.text % filled
        if without and style.drops_empty:
            key = without.lower() if style.lower_case else without
            lines = text.split(style.newline)
            text = style.newline.join(line for line in lines if line.split("=")[0].strip() != key)
        return text

    def _number(self, key: str, value: float) -> str:
        if key in _LENGTHS and self.style.millimetres:
            return f"{value * 1000.0:.10g}"
        if key in _PER_LENGTH and self.style.millimetres:
            return f"{value / 1000.0:.10g}"
        if key in _ANGLES and self.style.degrees:
            return f"{value / DEGREE:.8g}"
        if key in _PRESSURE_KEYS and self.style.bar:
            return f"{value / 1e5:.8g}"
        return self.style.number % value if key in _WRITTEN_COEFFICIENTS else f"{value:.8g}"

    def _line(self, key: str, value: str) -> str:
        style = self.style
        shown = key.lower() if style.lower_case else key
        gap = "\t\t" if style.tabs else " " * max(1, 25 - len(shown))
        remark = f"{style.comment}{_REMARKS[key]}" if style.remarks and key in _REMARKS else ""
        return f"{shown}{gap}= {value}" + (f"   {remark}" if remark else "")

    def _section(self, name: str) -> list[str]:
        title = name.lower().replace("_", " ")
        return [self.style.comment + title.rjust(70, "-"), f"[{name}]"]

    def _place(self, key: str) -> str:
        self.keys.append(key)
        return self._line(key, f"%({key})s")

    def _head(self, compound: bool) -> list[str]:
        style, line = self.style, self._line
        lines = [*self._section("MDI_HEADER")]
        lines += [line("FILE_TYPE", "'tir'"), line("FILE_VERSION", "3.0")]
        lines += [line("FILE_FORMAT", "'ASCII'"), *self._section("UNITS")]
        lines += [line("LENGTH", "'mm'" if style.millimetres else "'meter'")]
        lines += [line("FORCE", "'newton'")]
        lines += [line("ANGLE", "'degrees'" if style.degrees else "'radians'")]
        lines += [line("MASS", "'kg'"), line("TIME", "'second'")]
        if style.bar:
            lines += [line("PRESSURE", "'bar'")]
        lines += [*self._section("MODEL"), line("PROPERTY_FILE_FORMAT", "'MF-TYRE'")]
        if style.fittyp:
            lines += [line("FITTYP", style.fittyp)]
        lines += [line("TYPE", "'CAR'"), line("TYRESIDE", "'LEFT'"), line("USE_MODE", "14")]
        if compound:
            lines += [line("COMPOUND_CLASS", "'%(compound)s'")]
        return [*lines, self._place("VXLOW"), self._place("LONGVL")]

    def _numbers(self) -> list[str]:
        lines: list[str] = []
        for name, keys in _PLAIN_SECTIONS.items():
            lines += self._section(name)
            lines += [self._place(key) for key in keys]
            if name == "DIMENSION" and self.style.shape_table:
                lines += [*self._section("SHAPE"), "{radial width}"]
                lines += [" 1.0    0.0", " 1.0    0.4", " 1.0    0.9", " 0.9    1.0"]
        lines += self._section("SCALING_COEFFICIENTS")
        lines += [self._line(key, "1") for key in _WRITTEN_SCALE_FACTORS]
        for name, keys in WRITTEN_SECTIONS.items():
            lines += self._section(name)
            lines += [self._place(key) for key in keys]
        return lines


_PLAIN_SECTIONS: dict[str, list[str]] = {
    "DIMENSION": ["UNLOADED_RADIUS", "WIDTH", "ASPECT_RATIO", "RIM_RADIUS", "RIM_WIDTH"],
    "OPERATING_CONDITIONS": ["INFLPRES", "NOMPRES"],
    "INERTIA": ["MASS"],
    "VERTICAL": ["VERTICAL_STIFFNESS", "VERTICAL_DAMPING", "BREFF", "DREFF", "FREFF", "FNOMIN"],
    "LONG_SLIP_RANGE": ["KPUMIN", "KPUMAX"],
    "SLIP_ANGLE_RANGE": ["ALPMIN", "ALPMAX"],
    "INCLINATION_ANGLE_RANGE": ["CAMMIN", "CAMMAX"],
    "VERTICAL_FORCE_RANGE": ["FZMIN", "FZMAX"],
}
_LENGTHS = {"UNLOADED_RADIUS", "WIDTH", "RIM_RADIUS", "RIM_WIDTH", "LONGVL", "VXLOW"}
_PER_LENGTH = {"VERTICAL_STIFFNESS", "VERTICAL_DAMPING"}
_ANGLES = {"ALPMIN", "ALPMAX", "CAMMIN", "CAMMAX"}
_PRESSURE_KEYS = {"INFLPRES", "NOMPRES"}
_WRITTEN_COEFFICIENTS = {key for keys in WRITTEN_SECTIONS.values() for key in keys}
