"""What all explanations agree on, where a recording cannot tell them apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

Array = np.ndarray


def agreed(plain: Mapping[str, Array], each: Sequence[Mapping[str, Array]]) -> dict[str, Array]:
    """Return forces changed by as much as every explanation changes them at least.

    On the recording that was explained the explanations come to the same. At other loads, times and slips
    they need not: wear goes on and a gain stays. If one of them is true, its change has the sign and at least
    the size of what is returned, so that no sample becomes worse.

    Parameters
    ----------
    plain : mapping of str to ndarray, shape (n,)
        Output -> what the model predicts with nothing added, N or N m.
    each : sequence of mappings
        The same with each explanation added; one at least.

    Returns
    -------
    dict of ndarray, shape (n,)
        The smallest change of each sample, or none where explanations differ in its sign.
    """
    if len(each) == 1:
        return dict(each[0])
    out = {}
    for name, start in plain.items():
        changes = np.array([forces[name] - start for forces in each])
        one_sign = (changes > 0.0).all(axis=0) | (changes < 0.0).all(axis=0)
        least = np.take_along_axis(changes, np.abs(changes).argmin(axis=0)[None], axis=0)[0]
        out[name] = start + np.where(one_sign, least, 0.0)
    return out
