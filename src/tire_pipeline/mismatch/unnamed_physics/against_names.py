"""The named effects as what an equation competes with: on unseen sweeps, and in their own likelihood."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tire_pipeline.mismatch.inference.sets.answer import SetAnswer
from tire_pipeline.mismatch.inference.sets.enumerate import Enumerated
from tire_pipeline.mismatch.unnamed_physics.evidence import Model
from tire_pipeline.mismatch.unnamed_physics.library import Term
from tire_pipeline.mismatch.unnamed_physics.problems.unexplained import PRIOR_SIZE
from tire_pipeline.mismatch.unnamed_physics.products import Columns

Array = np.ndarray


@dataclass(frozen=True)
class Acting:
    """Terms of an equation, and the forces that they act on."""

    columns: Columns
    terms: Sequence[Term]
    outputs: Sequence[str]
    model: Model

    @property
    def price(self) -> float:
        """Minus the log prior of the terms: which of the library, how long, how many drivers."""
        return self.model.evidence - self.model.score

    def forces(self, every: Iterable[str]) -> dict[str, Array]:
        """Return the forces of the terms, N, of the size of the largest force, for each of some outputs."""
        live, columns, _ = self.columns.scaled(self.terms, self.outputs)
        none = np.zeros((self.columns.problem.table.size, len(live)))
        return {o: columns.get(o, none) for o in every}


@dataclass(frozen=True)
class NamesToBeat:
    """What an equation has to beat.

    Parameters
    ----------
    left : mapping of ndarray, shape (n,)
        Output -> what the named effects leave on unseen sweeps, N.
    sets : Enumerated, optional
        The likelihood in which they were weighed. Without it an equation is as likely as they are.
    answer : SetAnswer, optional
    """

    left: Mapping[str, Array]
    sets: Enumerated | None = None
    answer: SetAnswer | None = None

    def less_likely_than(self, equation: Sequence[Acting]) -> bool:
        """Whether an equation is likelier than all sets that hold names together.

        Both are weighed in one likelihood, beside the same misfit and background. On unseen sweeps an
        equation may be better because it takes up some of these, too; that speaks for no cause.
        """
        if self.sets is None or self.answer is None:
            return True
        outputs = self.sets.products.data.outputs
        forces = [part.forces(outputs) for part in equation]
        columns = {o: np.hstack([each[o] for each in forces]) for o in outputs}
        evidence = self.sets.log_evidence_of(columns, PRIOR_SIZE)
        return evidence - sum(part.price for part in equation) > self.answer.log_weight
