"""Names of results: names in the database, and words for groups of these names."""

from hakobune.bem import POWER
from hakobune.bem.database.schema import NEEDS_MOTION, ONLY_BY_NAME, QUANTITIES
from hakobune.bem.drift import OF_EACH

GROUPS = {
    "radiation": ("added_mass", "radiation_damping"),
    "limits": ("added_mass_zero", "added_mass_infinity"),
    "diffraction": ("Froude_Krylov_force", "diffraction_force", "excitation_force"),
    "kochin": ("kochin_radiation", "kochin_diffraction"),
    "motions": ("rao",),
    "lids": (POWER,),
    "drift": ("drift_force_fixed", "drift_force", *OF_EACH),
}
OF_MOTIONS = (*GROUPS["radiation"], *GROUPS["limits"], "kochin_radiation", *NEEDS_MOTION)


def expand(want, motions_known, held=False):
    """Names of the database for a list of names and group words, in the order of its table.

    want : list of str, or None for everything but `bem.database.schema.ONLY_BY_NAME`
    motions_known : whether the body's inertia is known; otherwise motions are excluded
    held : whether no body moves; waves by motions are then excluded too.
    Raises ValueError for an unknown word, and for unavailable motions that are requested by name.
    """
    if want is None:
        asked = set(QUANTITIES) - set(ONLY_BY_NAME)
    else:
        if not want:
            raise ValueError("want is an empty list; leave it out to get everything")
        unknown = [word for word in want if word not in GROUPS and word not in QUANTITIES]
        if unknown:
            words = ", ".join((*GROUPS, *QUANTITIES))
            raise ValueError(f"want has {unknown[0]!r}, which is not a result; allowed: {words}")
        asked = {name for word in want for name in GROUPS.get(word, (word,))}
    if held:
        named = [word for word in want or () if set(GROUPS.get(word, (word,))) <= set(OF_MOTIONS)]
        if named:
            raise ValueError(f"want has {named[0]}, but no body moves (fixed); leave it out")
        asked -= set(OF_MOTIONS)
    elif not motions_known:
        named = [word for word in want or () if word in NEEDS_MOTION or word == "motions"]
        if named:
            raise ValueError(f"{named[0]} needs the radii of gyration (m); give gyration (--gyration)")
        asked -= set(NEEDS_MOTION)
    return tuple([name for name in QUANTITIES if name in asked])
