"""Units as the names of columns state them: `frequency_Hz` is in hertz, `mass_kg` in kilograms."""

# The end of a column's name -> its unit. Longer ends come first, since `stiffness_N_m` ends in `_m` too.
_ENDS = {
    "_Hz_per_unit": "Hz per unit of the parameter", "_per_mass_m2_s2": "m2/s2", "_slip_m_per_N_s": "m/(N s)",
    "_N_s_m": "N s/m", "_kg_m2": "kg m2", "_kg_m3": "kg/m3", "_m2_s3": "m2/s3", "_m2_s2": "m2/s2", "_m_s2": "m/s2", "_N_m": "N/m", "_m_s": "m/s",
    "_m2": "m2", "_m3": "m3", "_m4": "m4", "_Hz": "Hz", "_pct": "%", "_deg": "deg", "_rad": "rad", "_kg": "kg", "_Pa": "Pa",
    "_m": "m", "_N": "N", "_s": "s", "_C": "C",
}
# Names that end like a unit and have none, or mean another one than their end says.
_EXCEPTIONS = {"moment_N_m": "N m", "sv1": "1/Hz", "sv2": "1/Hz", "sv3": "1/Hz", "seconds": "s"}


def unit_of_column(name: str) -> str:
    """The unit in a column's name; "" where it states none.

    >>> unit_of_column("frequency_std_Hz"), unit_of_column("density_kg_m3"), unit_of_column("mode")
    ('Hz', 'kg/m3', '')
    """
    if name in _EXCEPTIONS:
        return _EXCEPTIONS[name]
    return next((unit for end, unit in _ENDS.items() if name.endswith(end) and name != end[1:]), "")
