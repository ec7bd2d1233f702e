"""The standard sections of a ``.tir`` file, the order of their keys, and a short description of each key."""

from __future__ import annotations

import re

_LAYOUT_TEXT = """\
[MODEL]
PROPERTY_FILE_FORMAT
FITTYP Magic Formula version number
TYRESIDE Mounted side of the tyre
LONGVL Measurement speed
VXLOW Lower boundary of slip calculation
USE_MODE Tyre use switch
[DIMENSION]
UNLOADED_RADIUS Free tyre radius
WIDTH Nominal section width
ASPECT_RATIO Nominal aspect ratio
RIM_RADIUS Nominal rim radius
RIM_WIDTH Rim width
[OPERATING_CONDITIONS]
INFLPRES Tyre inflation pressure
NOMPRES Nominal tyre inflation pressure
[INERTIA]
MASS Tyre Mass
IXX Tyre diametral moment of inertia
IYY Tyre polar moment of inertia
BELT_MASS Belt mass
BELT_IXX Belt diametral moment of inertia
BELT_IYY Belt polar moment of inertia
GRAVITY Gravity acting on belt in Z direction
[VERTICAL]
FNOMIN Nominal wheel load
VERTICAL_STIFFNESS Tyre vertical stiffness
VERTICAL_DAMPING Tyre vertical damping
MC_CONTOUR_A Motorcycle contour ellipse A
MC_CONTOUR_B Motorcycle contour ellipse B
BREFF Low load stiffness effective rolling radius
DREFF Peak value of effective rolling radius
FREFF High load stiffness effective rolling radius
Q_RE0 Ratio of free tyre radius with nominal tyre radius
Q_V1 Tyre radius increase with speed
Q_V2 Vertical stiffness increase with speed
Q_FZ2 Quadratic term in load vs. deflection
Q_FCX Longitudinal force influence on vertical stiffness
Q_FCY Lateral force influence on vertical stiffness
Q_CAM Stiffness reduction due to camber
PFZ1 Pressure effect on vertical stiffness
Q_FCY2 Explicit load dependency for including the lateral force influence on vertical stiffness
Q_CAM1 Linear load dependent camber angle influence on vertical stiffness
Q_CAM2 Quadratic load dependent camber angle influence on vertical stiffness
Q_CAM3 Linear load and camber angle dependent reduction on vertical stiffness
Q_FYS1 Combined camber angle and side slip angle effect on vertical stiffness (constant)
Q_FYS2 Combined camber angle and side slip angle linear effect on vertical stiffness
Q_FYS3 Combined camber angle and side slip angle quadratic effect on vertical stiffness
BOTTOM_OFFST Distance to rim when bottoming starts to occur
BOTTOM_STIFF Vertical stiffness of bottomed tyre
DYNAMIC_STIFFNESS Dynamic stiffness rate
DYNAMIC_DAMPING Dynamic damping
[STRUCTURAL]
LONGITUDINAL_STIFFNESS Tyre overall longitudinal stiffness
LATERAL_STIFFNESS Tyre overall lateral stiffness
YAW_STIFFNESS Tyre overall yaw stiffness
FREQ_LONG Undamped frequency fore/aft and vertical mode
FREQ_LAT Undamped frequency lateral mode
FREQ_YAW Undamped frequency yaw and camber mode
FREQ_WINDUP Undamped frequency wind-up mode
DAMP_LONG Dimensionless damping fore/aft and vertical mode
DAMP_LAT Dimensionless damping lateral mode
DAMP_YAW Dimensionless damping yaw and camber mode
DAMP_WINDUP Dimensionless damping wind-up mode
DAMP_RESIDUAL Residual damping (proportional to stiffness)
DAMP_VLOW Additional low speed damping (proportional to stiffness)
Q_BVX Load and speed influence on in-plane translation stiffness
Q_BVT Load and speed influence on in-plane rotation stiffness
PCFX1 Tyre overall longitudinal stiffness vertical deflection dependency linear term
PCFX2 Tyre overall longitudinal stiffness vertical deflection dependency quadratic term
PCFX3 Tyre overall longitudinal stiffness pressure dependency
PCFY1 Tyre overall lateral stiffness vertical deflection dependency linear term
PCFY2 Tyre overall lateral stiffness vertical deflection dependency quadratic term
PCFY3 Tyre overall lateral stiffness pressure dependency
PCMZ1 Tyre overall yaw stiffness pressure dependency
[CONTACT_PATCH]
Q_RA1 Square root term in contact length equation
Q_RA2 Linear term in contact length equation
Q_RB1 Root term in contact width equation
Q_RB2 Linear term in contact width equation
ELLIPS_SHIFT Scaling of distance between front and rear ellipsoid
ELLIPS_LENGTH Semi major axis of ellipsoid
ELLIPS_HEIGHT Semi minor axis of ellipsoid
ELLIPS_ORDER Order of ellipsoid
ELLIPS_MAX_STEP Maximum height of road step
ELLIPS_NWIDTH Number of parallel ellipsoids
ELLIPS_NLENGTH Number of ellipsoids at sides of contact patch
ENV_C1 Effective height attenuation
ENV_C2 Effective plane angle attenuation
[INFLATION_PRESSURE_RANGE]
PRESMIN Minimum valid tyre inflation pressure
PRESMAX Maximum valid tyre inflation pressure
[VERTICAL_FORCE_RANGE]
FZMIN Minimum allowed wheel load
FZMAX Maximum allowed wheel load
[LONG_SLIP_RANGE]
KPUMIN Minimum valid wheel slip
KPUMAX Maximum valid wheel slip
[SLIP_ANGLE_RANGE]
ALPMIN Minimum valid slip angle
ALPMAX Maximum valid slip angle
[INCLINATION_ANGLE_RANGE]
CAMMIN Minimum valid camber angle
CAMMAX Maximum valid camber angle
[SCALING_COEFFICIENTS]
LFZO Scale factor of nominal (rated) load
LCX Scale factor of Fx shape factor
LMUX Scale factor of Fx peak friction coefficient
LEX Scale factor of Fx curvature factor
LKX Scale factor of Fx slip stiffness
LHX Scale factor of Fx horizontal shift
LVX Scale factor of Fx vertical shift
LCY Scale factor of Fy shape factor
LMUY Scale factor of Fy peak friction coefficient
LEY Scale factor of Fy curvature factor
LKY Scale factor of Fy cornering stiffness
LHY Scale factor of Fy horizontal shift
LVY Scale factor of Fy vertical shift
LTR Scale factor of peak of pneumatic trail
LRES Scale factor for offset of residual torque
LXAL Scale factor of alpha influence on Fx
LYKA Scale factor of kappa influence on Fy
LVYKA Scale factor of kappa induced Fy
LS Scale factor of moment arm of Fx
LKYC Scale factor of camber force stiffness
LKZC Scale factor of camber torque stiffness
LVMX Scale factor of Mx vertical shift
LMX Scale factor of overturning couple
LMY Scale factor of rolling resistance torque
LMP Scale factor of Parking Moment
LGAX Scale factor of camber for Fx
LGAY Scale factor of camber for Fy
LKG Scale factor of tire camber stiffness
LGAZ Scale factor of camber for Mz
LSGKP Scale factor of Relaxation length of Fx
LSGAL Scale factor of Relaxation length of Fy
LGYR Scale factor of gyroscopic torque
LCZ Scale factor of tire vertical stiffness
LIP Scale factor of inflation pressure
[LONGITUDINAL_COEFFICIENTS]
PCX1 Shape factor Cfx for longitudinal force
PDX1 Longitudinal friction Mux at Fznom
PDX2 Variation of friction Mux with load
PDX3 Variation of friction Mux with camber squared
PEX1 Longitudinal curvature Efx at Fznom
PEX2 Variation of curvature Efx with load
PEX3 Variation of curvature Efx with load squared
PEX4 Factor in curvature Efx while driving
PKX1 Longitudinal slip stiffness Kfx/Fz at Fznom
PKX2 Variation of slip stiffness Kfx/Fz with load
PKX3 Exponent in slip stiffness Kfx/Fz with load
PHX1 Horizontal shift Shx at Fznom
PHX2 Variation of shift Shx with load
PVX1 Vertical shift Svx/Fz at Fznom
PVX2 Variation of shift Svx/Fz with load
PPX1 Linear influence of inflation pressure on longitudinal slip stiffness
PPX2 Quadratic influence of inflation pressure on longitudinal slip stiffness
PPX3 Linear influence of inflation pressure on peak longitudinal friction
PPX4 Quadratic influence of inflation pressure on peak longitudinal friction
RBX1 Slope factor for combined slip Fx reduction
RBX2 Variation of slope Fx reduction with kappa
RBX3 Influence of camber on stiffness for Fx combined
RCX1 Shape factor for combined slip Fx reduction
REX1 Curvature factor of combined Fx
REX2 Curvature factor of combined Fx with load
RHX1 Shift factor for combined slip Fx reduction
PTX1 Relaxation length SigKap0/Fz at Fznom
PTX2 Variation of SigKap0/Fz with load
PTX3 Variation of SigKap0/Fz with exponent of load
PTX4 Low speed damping
[OVERTURNING_COEFFICIENTS]
QSX1 Vertical shift of overturning moment
QSX2 Camber induced overturning couple
QSX3 Fy induced overturning couple
QSX4 Mixed load lateral force and camber on Mx
QSX5 Load effect on Mx with lateral force and camber
QSX6 B-factor of load with Mx
QSX7 Camber with load on Mx
QSX8 Lateral force with load on Mx
QSX9 B-factor of lateral force with load on Mx
QSX10 Vertical force with camber on Mx
QSX11 B-factor of vertical force with camber on Mx
QSX12 Camber squared induced overturning moment
QSX13 Lateral force induced overturning moment
QSX14 Lateral force induced overturning moment with camber
PPMX1 Influence of inflation pressure on overturning moment
QPX1 Variation of camber effect with pressure
[LATERAL_COEFFICIENTS]
PCY1 Shape factor Cfy for lateral forces
PDY1 Lateral friction Muy
PDY2 Variation of friction Muy with load
PDY3 Variation of friction Muy with squared camber
PEY1 Lateral curvature Efy at Fznom
PEY2 Variation of curvature Efy with load
PEY3 Zero order camber dependency of curvature Efy
PEY4 Variation of curvature Efy with camber
PEY5 Variation of curvature Efy with camber squared
PKY1 Maximum value of stiffness Kfy/Fznom
PKY2 Load at which Kfy reaches maximum value
PKY3 Variation of Kfy/Fznom with camber
PKY4 Curvature of stiffness Kfy
PKY5 Peak stiffness variation with camber squared
PKY6 Fy camber stiffness factor
PKY7 Vertical load dependency of camber stiffness
PHY1 Horizontal shift Shy at Fznom
PHY2 Variation of shift Shy with load
PHY3 Variation of shift Shy with camber
PVY1 Vertical shift in Svy/Fz at Fznom
PVY2 Variation of shift Svy/Fz with load
PVY3 Variation of shift Svy/Fz with camber
PVY4 Variation of shift Svy/Fz with camber and load
PPY1 Influence of inflation pressure on cornering stiffness
PPY2 Influence of inflation pressure on dependency of nominal tyre load on cornering stiffness
PPY3 Linear influence of inflation pressure on lateral peak friction
PPY4 Quadratic influence of inflation pressure on lateral peak friction
PPY5 Influence of inflation pressure on camber stiffness
RBY1 Slope factor for combined Fy reduction
RBY2 Variation of slope Fy reduction with alpha
RBY3 Shift term for alpha in slope Fy reduction
RBY4 Influence of camber on stiffness of Fy combined
RCY1 Shape factor for combined Fy reduction
REY1 Curvature factor of combined Fy
REY2 Curvature factor of combined Fy with load
RHY1 Shift factor for combined Fy reduction
RHY2 Shift factor for combined Fy reduction with load
RVY1 Kappa induced side force Svyk/Muy*Fz at Fznom
RVY2 Variation of Svyk/Muy*Fz with load
RVY3 Variation of Svyk/Muy*Fz with camber
RVY4 Variation of Svyk/Muy*Fz with alpha
RVY5 Variation of Svyk/Muy*Fz with kappa
RVY6 Variation of Svyk/Muy*Fz with atan(kappa)
PTY1 Peak value of relaxation length SigAlp0/R0
PTY2 Value of Fz/Fznom where SigAlp0 is extreme
PTY3 Artificial damping for low speed
[ROLLING_COEFFICIENTS]
QSY1 Rolling resistance torque coefficient
QSY2 Rolling resistance torque depending on Fx
QSY3 Rolling resistance torque depending on speed
QSY4 Rolling resistance torque depending on speed ^4
QSY5 Rolling resistance torque depending on camber squared
QSY6 Rolling resistance torque depending on load and camber squared
QSY7 Rolling resistance torque coefficient load dependency
QSY8 Rolling resistance torque coefficient pressure dependency
[ALIGNING_COEFFICIENTS]
QBZ1 Trail slope factor for trail Bpt at Fznom
QBZ2 Variation of slope Bpt with load
QBZ3 Variation of slope Bpt with load squared
QBZ4 Variation of slope Bpt with camber
QBZ5 Variation of slope Bpt with absolute camber
QBZ9 Factor for scaling factors of slope factor Br of Mzr
QBZ10 Factor for dimensionless cornering stiffness of Br of Mzr
QCZ1 Shape factor Cpt for pneumatic trail
QDZ1 Peak trail Dpt = Dpt*(Fz/Fznom*R0)
QDZ2 Variation of peak Dpt' with load
QDZ3 Variation of peak Dpt' with camber
QDZ4 Variation of peak Dpt' with camber squared
QDZ6 Peak residual torque Dmr' = Dmr/(Fz*R0)
QDZ7 Variation of peak factor Dmr' with load
QDZ8 Variation of peak factor Dmr' with camber
QDZ9 Variation of peak factor Dmr' with camber and load
QDZ10 Variation of peak factor Dmr with camber squared
QDZ11 Variation of Dmr with camber squared and load
QEZ1 Trail curvature Ept at Fznom
QEZ2 Variation of curvature Ept with load
QEZ3 Variation of curvature Ept with load squared
QEZ4 Variation of curvature Ept with sign of Alpha-t
QEZ5 Variation of Ept with camber and sign Alpha-t
QHZ1 Trail horizontal shift Sht at Fznom
QHZ2 Variation of shift Sht with load
QHZ3 Variation of shift Sht with camber
QHZ4 Variation of shift Sht with camber and load
PPZ1 Effect of inflation pressure on length of pneumatic trail
PPZ2 Influence of inflation pressure on residual aligning torque
SSZ1 Nominal value of s/R0: effect of Fx on Mz
SSZ2 Variation of distance s/R0 with Fy/Fznom
SSZ3 Variation of distance s/R0 with camber
SSZ4 Variation of distance s/R0 with load and camber
QPZ1 Variation of peak Dpt with pressure
QPZ2 Variation of peak Dmr with pressure
QTZ1 Gyration torque constant
MBELT Belt mass of the wheel
[TURNSLIP_COEFFICIENTS]
PDXP1 Peak Fx reduction due to spin parameter
PDXP2 Peak Fx reduction due to spin with varying load parameter
PDXP3 Peak Fx reduction due to spin with kappa parameter
PKYP1 Cornering stiffness reduction due to spin
PDYP1 Peak Fy reduction due to spin parameter
PDYP2 Peak Fy reduction due to spin with varying load parameter
PDYP3 Peak Fy reduction due to spin with alpha parameter
PDYP4 Peak Fy reduction due to square root of spin parameter
PHYP1 Fy-alpha curve lateral shift limitation
PHYP2 Fy-alpha curve maximum lateral shift parameter
PHYP3 Fy-alpha curve maximum lateral shift varying with load parameter
PHYP4 Fy-alpha curve maximum lateral shift parameter
PECP1 Camber w.r.t. spin reduction factor parameter in camber stiffness
PECP2 Camber w.r.t. spin reduction factor varying with load parameter in camber stiffness
QDTP1 Pneumatic trail reduction factor due to turn slip parameter
QCRP1 Turning moment at constant turning and zero forward speed parameter
QCRP2 Turn slip moment (at alpha = 90deg) parameter for increase with spin
QBRP1 Residual (spin) torque reduction factor parameter due to side slip
QDRP1 Turn slip moment peak magnitude parameter
"""


def _parse() -> dict[str, dict[str, str]]:
    sections: dict[str, dict[str, str]] = {}
    section: dict[str, str] = {}
    for line in _LAYOUT_TEXT.splitlines():
        if line.startswith("["):
            section = sections.setdefault(line.strip("[]"), {})
        else:
            key, _, words = line.partition(" ")
            section[key] = words
    return sections


LAYOUT = _parse()
"""Section -> key -> description, in writing order."""

_SECTION_OF_KEY = {key: section for section, keys in LAYOUT.items() for key in keys if section != "INERTIA"}
_BY_PATTERN = (
    (r"L[A-Z]+\d?", "SCALING_COEFFICIENTS"),
    (r"[PQ][A-Z]{2}P\d+", "TURNSLIP_COEFFICIENTS"),
    (r"QSX\d+|QPX\d+|PPMX\d+", "OVERTURNING_COEFFICIENTS"),
    (r"QSY\d+", "ROLLING_COEFFICIENTS"),
    (r"[PQS][A-Z]Z\d+", "ALIGNING_COEFFICIENTS"),
    (r"[PR][A-Z]X\d+", "LONGITUDINAL_COEFFICIENTS"),
    (r"[PR][A-Z]Y\d+", "LATERAL_COEFFICIENTS"),
)


def home_section(coefficient: str) -> str:
    """Return the section in which a coefficient is written.

    Examples
    --------
    >>> home_section("PCY1"), home_section("FNOMIN"), home_section("PDY9")
    ('LATERAL_COEFFICIENTS', 'VERTICAL', 'LATERAL_COEFFICIENTS')
    """
    if coefficient in _SECTION_OF_KEY:
        return _SECTION_OF_KEY[coefficient]
    for pattern, section in _BY_PATTERN:
        if re.fullmatch(pattern, coefficient):
            return section
    return "VERTICAL"


def describe(section: str, key: str) -> str:
    """Return a few words on a key, or nothing."""
    return LAYOUT.get(section, {}).get(key, "")
