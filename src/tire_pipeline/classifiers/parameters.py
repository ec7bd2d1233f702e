"""Parameters of ``train_classifier``."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from tire_pipeline.parameters import Parameters


class ForestParameters(Parameters):
    """Size of the forest (thesis, Table 5.5)."""

    trees: int = Field(30, ge=1, le=1000)
    depth: int = Field(10, ge=1, le=100)


class AnnParameters(Parameters):
    """Training of the ANN (thesis, Table 5.4)."""

    epochs: int = Field(300, ge=1)
    batch_size: int = Field(32, ge=1)
    learning_rate: float = Field(1e-3, gt=0)
    weight_decay: float = Field(0.01, ge=0)


class TrainClassifierParameters(Parameters):
    """Parameters of ``train_classifier``.

    Attributes
    ----------
    smote : bool
        Balance the training set with SMOTE.
    trainings : int
        Figures are means over this many.
    forest : ForestParameters
    ann : AnnParameters
    """

    smote: bool = True
    trainings: int = Field(10, ge=1)
    forest: ForestParameters = ForestParameters()
    ann: AnnParameters = AnnParameters()

    def options(self, name: str) -> dict[str, Any]:
        """Constructor arguments of one classifier."""
        forest = {"n_trees": self.forest.trees, "max_depth": self.forest.depth}
        own = {"random_forest": forest, "ann": self.ann.model_dump()}
        return {"smote": self.smote, **own.get(name, {})}
