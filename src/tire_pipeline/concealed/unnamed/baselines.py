"""What else is tried on the residual: PySINDy, a Gaussian process, gradient boosting."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pandas as pd
from sklearn.ensemble import HistGradientBoostingRegressor

from tire_pipeline.channels import OPERATING_CHANNELS, TANGENTIAL_FORCES
from tire_pipeline.concealed.baselines import explain_gaussian_process, explain_sindy
from tire_pipeline.concealed.cases.clean_run import model_forces, residual
from tire_pipeline.magic_formula import TireModel

Predict = Callable[[pd.DataFrame], pd.DataFrame]


def boosted(tire: TireModel, recording: pd.DataFrame) -> Predict:
    """Fit gradient boosting (100 trees of 15 leaves) to the residual of both forces over all channels."""
    channels = [c for c in OPERATING_CHANNELS if c in recording]
    left, x = residual(tire, recording), recording[channels].to_numpy()
    trees = [
        HistGradientBoostingRegressor(max_iter=100, max_leaf_nodes=15, random_state=0).fit(x, left[:, i])
        for i in range(2)
    ]

    def predict(frame: pd.DataFrame) -> pd.DataFrame:
        added = np.column_stack([tree.predict(frame[channels].to_numpy()) for tree in trees])
        return pd.DataFrame(
            model_forces(tire, frame) + added, columns=list(TANGENTIAL_FORCES), index=frame.index
        )

    return predict


ON_RESIDUAL: dict[str, Callable[[TireModel, pd.DataFrame], Predict]] = {
    "pysindy": lambda tire, recording: explain_sindy(tire, recording).predict,
    "gaussian_process": lambda tire, recording: explain_gaussian_process(tire, recording).predict,
    "gradient_boosting": boosted,
}
"""Name -> function of (tire, recording) that gives a prediction."""
