"""A training by stable-baselines3, with the progress of any other loop and no log folder of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tire_pipeline.progress.track import track

if TYPE_CHECKING:
    from stable_baselines3.common.base_class import BaseAlgorithm
    from stable_baselines3.common.callbacks import BaseCallback


def learn(agent: BaseAlgorithm, total_steps: int, steps_per_update: int, what: str) -> None:
    """Train an agent, without the folder that stable-baselines3 leaves in the system's /tmp for each.

    Parameters
    ----------
    agent : BaseAlgorithm
    total_steps, steps_per_update : int
        Steps of all environments together.
    what : str
        What the progress is labelled with.
    """
    from stable_baselines3.common.logger import Logger

    agent.set_logger(Logger(folder=None, output_formats=[]))
    agent.learn(total_steps, training_progress(total_steps, steps_per_update, what))


def training_progress(total_steps: int, steps_per_update: int, what: str) -> BaseCallback:
    """Return a callback that shows how many updates are done.

    Parameters
    ----------
    total_steps, steps_per_update : int
        Steps of all environments together.
    what : str
        The label.
    """
    from stable_baselines3.common.callbacks import BaseCallback  # it takes a second

    class Progress(BaseCallback):
        def _on_training_start(self) -> None:
            self.updates = track(range(-(-total_steps // steps_per_update)), what)

        def _on_rollout_start(self) -> None:
            next(self.updates, None)

        def _on_step(self) -> bool:
            return True

        def _on_training_end(self) -> None:
            self.updates.close()

    return Progress()
