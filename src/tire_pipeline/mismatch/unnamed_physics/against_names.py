"""The named effects as what an equation competes with: on unseen sweeps, and in their own likelihood."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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

    def forces(self) -> list[dict[str, Array]]:
        """Return the force of each term, N, of the size of the largest force, by output."""
        out, problem = [], self.columns.problem
        for term in self.terms:
            every = self.columns.of(term) or {}
            acting = {o: every[o] for o in self.outputs if o in every}
            size = max((float(np.sqrt(np.mean(x**2))) / problem.largest[o] for o, x in acting.items()))
            out.append({o: x / size for o, x in acting.items()} if size > 0.0 else {})
        return out


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
        forces = [force for part in equation for force in part.forces()]
        none = np.zeros(self.sets.products.data.size)
        columns = {
            o: np.column_stack([force.get(o, none) for force in forces]) for o in self.sets.products.largest
        }
        evidence = self.sets.log_evidence_of(columns, PRIOR_SIZE)
        return evidence - sum(part.price for part in equation) > self.answer.log_weight
