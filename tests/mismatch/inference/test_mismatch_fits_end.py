"""Fits end, whatever their steps promise."""

from weighed import all_but

from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.inference.sets import fitting


def test_a_fit_ends_where_each_of_two_steps_undoes_the_other(tire, record, monkeypatch):
    """Each gained near one size of the misfit: such a recording was never explained."""
    steps = []

    def back_and_forth(products, likelihood, changes, free):
        steps.append(1)
        assert len(steps) < 100
        name, values = changes[0]
        there = 0.05 if values["friction"] < 0.05 else 0.0
        return [(name, {**values, "friction": there}), *changes[1:]], 1.0, likelihood

    monkeypatch.setattr(fitting, "_step", back_and_forth)
    Explainer(without=all_but("friction_scale")).weigh(tire, record(3).iloc[:400])
    assert steps
