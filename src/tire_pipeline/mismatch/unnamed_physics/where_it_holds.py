"""Where an equation was seen to hold: where its terms came together, and where its play is known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from tire_pipeline.mismatch.model.channels import DOES_NOTHING, largest
from tire_pipeline.mismatch.proof.nested import FOLDS
from tire_pipeline.mismatch.proof.never_worse import confirmed_by_later, fifths
from tire_pipeline.mismatch.unnamed_physics.found import FADE
from tire_pipeline.mismatch.unnamed_physics.language.grammar import SymbolTable, evaluate, number, parse
from tire_pipeline.mismatch.unnamed_physics.library import Factor

Array = np.ndarray


def distance(terms: Mapping[str, Array]) -> tuple[str, float] | None:
    """Return how far the terms of an equation are out together, and the most that was recorded of it.

    Two terms may cancel wherever they grew together, and only there: at high speed with a small slip angle,
    where each by itself was recorded, nothing says what is left of them. The distance is that of
    Mahalanobis, from zero: the square root of the leverage that a sample would have in the fit.

    Parameters
    ----------
    terms : mapping of ndarray, shape (n,)
        Text of a term -> its values in the recording, N.

    Returns
    -------
    (str, float) or None
        The distance as an expression of the grammar, and what 99% of the samples stay below. None for a
        single term: how large that may be, the ranges of its channels say.
    """
    if len(terms) < 2:
        return None
    x = np.column_stack(list(terms.values()))
    sizes, directions = np.linalg.eigh(x.T @ x / len(x))
    white = directions / np.sqrt(np.maximum(sizes, DOES_NOTHING**2 * sizes[-1]))
    forms = [
        " + ".join(f"{number(float(w))}*{text}" for w, text in zip(form, terms, strict=True))
        for form in white.T
    ]
    text = "sqrt(" + " + ".join(f"({form})^2" for form in forms) + ")"
    return text, largest(np.linalg.norm(x @ white, axis=1))


def part_that_later_sweeps_confirm(
    terms: Sequence[Mapping[str, Array]],
    rest: Mapping[str, Array],
    largest_force: Mapping[str, float],
    block: Array,
) -> float:
    """Return the part of an equation that earlier sweeps predict of later ones, 0 to 1.

    After the recording nothing is left to its later side, and what turns with the way loses its angle where
    the way is a little wrong. Each fifth of the sweeps is predicted with coefficients by those before it.

    Parameters
    ----------
    terms : sequence of mapping of ndarray, shape (n,)
        What each term does to each force with coefficient 1, N.
    rest : mapping of ndarray, shape (n,)
        Residual of each force that the equation acts on, N.
    largest_force : mapping of float
        N.
    block : ndarray of int, shape (n,)
        Sweep of each sample.
    """
    fold = fifths(block)
    x = {o: np.column_stack([term[o] for term in terms]) / largest_force[o] for o in rest}
    left = {o: r.copy() for o, r in rest.items()}
    for fifth in range(1, FOLDS):
        seen, later = fold < fifth, fold == fifth
        columns = np.vstack([each[seen] for each in x.values()])
        wanted = np.concatenate([r[seen] / largest_force[o] for o, r in rest.items()])
        size = np.linalg.lstsq(columns, wanted)[0]
        for o, r in left.items():
            r[later] -= x[o][later] @ size * largest_force[o]
    return confirmed_by_later(rest, left, largest_force, block)


def way_through_play(factor: Factor, table: SymbolTable) -> tuple[str, tuple[float, float]] | None:
    """Return how far what goes through a play went to both sides, and where the play is known.

    Where a recording starts nobody knows at which end of its gap a joint is. It is known once what goes
    through it has spanned the gap. The range begins there, or where its fade ends at nothing spanned.

    Parameters
    ----------
    factor : Factor
    table : SymbolTable

    Returns
    -------
    (str, (float, float)) or None
        What was spanned as an expression of the grammar; twice the play's half width, and what the recording
        spans. None for a factor without play.
    """
    begins = "play("
    if not factor.text.startswith(begins):
        return None
    inside = factor.text[len(begins) : factor.text.index(", {}")]
    text = f"highest({inside}) + highest(-({inside}))"
    most = float(evaluate(parse(text), table)[-1])
    return text, (min(max(2.0 * factor.value, most * FADE / (1.0 + FADE)), most), most)
