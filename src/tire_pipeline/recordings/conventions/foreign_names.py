"""German and French names of the channels, as rigs and textbooks print them; no standard was looked up.

Only words that mean one quantity at a tire are here. A word that may be another one is not, so that it is
asked about: ``Luftdruck`` (of the tire or of the weather), ``Drehzahl`` (of the wheel or of a motor),
``Lenkwinkel`` (of the wheel or of the driver's hands), ``Bremsschlupf`` (of either sign), ``dérive`` (drift,
too), ``Druck``.
"""

from __future__ import annotations

GERMAN: dict[str, tuple[str, ...]] = {
    "time": ("Zeit", "Messzeit", "Versuchszeit"),
    "slip_angle": ("Schräglaufwinkel", "Schräglauf", "Reifenschräglaufwinkel"),
    "slip_ratio": ("Schlupf", "Längsschlupf", "Umfangsschlupf", "Reifenlängsschlupf"),
    "camber": ("Sturzwinkel", "Sturz", "Radsturz"),
    "normal_load": (
        *("Radlast", "Reifenlast", "Radaufstandskraft", "Reifenaufstandskraft", "Aufstandskraft"),
        *("Vertikalkraft", "Reifenvertikalkraft", "Normalkraft"),
    ),
    "speed": (
        *("Geschwindigkeit", "Fahrgeschwindigkeit", "Bandgeschwindigkeit", "Fahrbahngeschwindigkeit"),
        "Fahrzeuggeschwindigkeit",
    ),
    "pressure": ("Reifendruck", "Fülldruck", "Reifenfülldruck", "Reifeninnendruck", "Reifenluftdruck"),
    "tread_temperature": (
        "Laufflächentemperatur",
        "Reifenoberflächentemperatur",
        "Protektortemperatur",
    ),
    "fx": ("Längskraft", "Umfangskraft", "Reifenlängskraft", "Reifenumfangskraft"),
    "fy": ("Seitenkraft", "Querkraft", "Reifenseitenkraft", "Reifenquerkraft", "Seitenführungskraft"),
    "mx": ("Kippmoment", "Reifenkippmoment"),
    "my": ("Rollwiderstandsmoment",),
    "mz": ("Rückstellmoment", "Reifenrückstellmoment"),
    "wheel_speed": ("Raddrehzahl", "Radwinkelgeschwindigkeit"),
    "effective_radius": ("dynamischer Rollradius", "Rollradius", "dynamischer Reifenhalbmesser"),
    "ambient_temperature": ("Umgebungstemperatur", "Lufttemperatur"),
    "surface_temperature": ("Fahrbahntemperatur",),
    "yaw_rate": ("Gierrate", "Giergeschwindigkeit", "Gierwinkelgeschwindigkeit"),
    "lateral_acceleration": ("Querbeschleunigung",),
    "longitudinal_acceleration": ("Längsbeschleunigung",),
    "lateral_speed": ("Quergeschwindigkeit",),
    "sideslip": ("Schwimmwinkel",),
}

FRENCH: dict[str, tuple[str, ...]] = {
    "time": ("temps",),
    "slip_angle": ("angle de dérive",),
    "slip_ratio": ("glissement longitudinal", "taux de glissement"),
    "camber": ("angle de carrossage", "carrossage"),
    "normal_load": (
        "charge verticale",
        "effort vertical",
        "force verticale",
        "force normale",
        "effort normal",
    ),
    "speed": ("vitesse", "vitesse de roulage"),
    "pressure": ("pression de gonflage", "pression pneumatique", "pression du pneu"),
    "tread_temperature": ("température de la bande de roulement", "température bande de roulement"),
    "fx": ("effort longitudinal", "force longitudinale"),
    "fy": ("effort latéral", "force latérale", "effort transversal", "force transversale"),
    "mx": ("moment de renversement", "couple de renversement"),
    "my": ("moment de résistance au roulement", "couple de résistance au roulement"),
    "mz": ("moment d'auto-alignement", "couple d'auto-alignement", "couple d'autoalignement"),
    "ambient_temperature": ("température ambiante",),
    "yaw_rate": ("vitesse de lacet",),
    "lateral_acceleration": ("accélération latérale", "accélération transversale"),
    "longitudinal_acceleration": ("accélération longitudinale",),
}

_WITHOUT_UMLAUTS = {"ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss"}


def foreign_names(channel: str) -> list[str]:
    """Return a channel's German and French names; German ones with ``ae`` for ``ä`` as well.

    Examples
    --------
    >>> foreign_names("mx")
    ['Kippmoment', 'Reifenkippmoment', 'moment de renversement', 'couple de renversement']
    >>> foreign_names("mz")[:2]
    ['Rückstellmoment', 'Rueckstellmoment']
    """
    spelled = []
    for name in GERMAN.get(channel, ()):
        plain = "".join(_WITHOUT_UMLAUTS.get(letter, letter) for letter in name)
        spelled += [name] if plain == name else [name, plain]
    return [*spelled, *FRENCH.get(channel, ())]
