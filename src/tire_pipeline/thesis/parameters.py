"""Parameters of ``reproduce_thesis``."""

from __future__ import annotations

from itertools import product
from typing import Any, Literal

from pydantic import Field

from tire_pipeline.parameters import Parameters
from tire_pipeline.translation.thesis.grid import Cell


class GridParameters(Parameters):
    """The grid of Table 4.4, one agent for every combination; and representations that the thesis lacks.

    ``power_series`` is the form of Appendix C, ``power_series_stable`` the one that can be inverted.
    """

    algorithms: tuple[Literal["PPO", "A2C"], ...] = ("PPO", "A2C")
    rewards: tuple[Literal["reach_target_fast", "maximize_reward"], ...] = (
        "reach_target_fast",
        "maximize_reward",
    )
    representations: tuple[Literal["coefficients", "key_attributes", "latent", "power_series"], ...] = (
        "coefficients",
        "key_attributes",
        "latent",
        "power_series",
    )
    further_representations: tuple[Literal["power_series_stable"], ...] = ("power_series_stable",)
    bins: tuple[int, ...] = (10, 20, 40)

    @property
    def all_representations(self) -> tuple[str, ...]:
        """The thesis' and the further ones."""
        return (*self.representations, *self.further_representations)

    @property
    def cells(self) -> tuple[Cell, ...]:
        """All combinations."""
        return tuple(
            Cell(*values)
            for values in product(self.algorithms, self.rewards, self.all_representations, self.bins)
        )


class AgentParameters(Parameters):
    """Training of every agent.

    Attributes
    ----------
    seeds : tuple of int
        One training each; the thesis shows one. Figures are means, with the spread.
    total_steps : int, optional
        Of all environments together; without it 100,000 for PPO and 300,000 for A2C.
    """

    seeds: tuple[int, ...] = Field(default=(1, 2, 3), min_length=1)
    total_steps: int | None = Field(default=None, ge=1)


class AnnSearchParameters(Parameters):
    """Tuning of the ANN.

    Attributes
    ----------
    random : int
        Combinations of the random search.
    best : int
        So many of its best say which values go into the grid.
    whole_grid : tuple of {"random", "by_tire"}
        Kinds of folds on which all 1,728 combinations are tried; on the others, as in the thesis, those
        that the random search leaves.
    epochs : tuple of int, optional
        Instead of Table 4.2's, for a quick run.
    """

    random: int = Field(default=40, ge=5, le=1728)
    best: int = Field(default=6, ge=1)
    whole_grid: tuple[Literal["random", "by_tire"], ...] = ("random",)
    epochs: tuple[int, ...] | None = None


class ForestSearchParameters(Parameters):
    """Tuning of the forest (Table 4.3); ``trees``: with how many the depth is varied."""

    trees: int = Field(default=30, ge=1)
    most_trees: int = Field(default=100, ge=1)
    most_depth: int = Field(default=100, ge=1)


class ReproduceThesisParameters(Parameters):
    """Parameters of ``reproduce_thesis``.

    Attributes
    ----------
    grid : GridParameters
    agents : AgentParameters
    sets : tuple of str
        Evaluation tires: ``four`` are the thesis' 16 translations, ``hidden`` many more tires.
    latent_features, latent_epochs : int
        Of the latent representation.
    ann : AnnSearchParameters
    forest : ForestSearchParameters
    trainings : int
        Of each classifier (Tables 5.6 to 5.9).
    further_trainings : int
        Of the gradient-boosted and the calibrated classifier.
    bins : tuple of int
        Numbers of bins in Figures 5.5 to 5.8.
    latent_counts : tuple of int
        Numbers of latent features in Figure 5.4.
    """

    grid: GridParameters = GridParameters()
    agents: AgentParameters = AgentParameters()
    sets: tuple[str, ...] = Field(default=("four", "hidden"), min_length=1)
    latent_features: int = Field(default=8, ge=1, le=64)
    latent_epochs: int = Field(default=200, ge=1)
    ann: AnnSearchParameters = AnnSearchParameters()
    forest: ForestSearchParameters = ForestSearchParameters()
    trainings: int = Field(default=10, ge=1)
    further_trainings: int = Field(default=3, ge=1)
    bins: tuple[int, ...] = tuple(range(2, 41, 2))
    latent_counts: tuple[int, ...] = tuple(range(1, 17))

    def representation_options(self, name: str) -> dict[str, Any]:
        """Constructor arguments of one representation."""
        if name == "latent":
            return {"n_features": self.latent_features, "epochs": self.latent_epochs}
        return {"form": "published"} if name == "power_series" else {}
