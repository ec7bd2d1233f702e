"""Fits end, whatever their steps promise."""

from weighed import all_but

from tire_pipeline.mismatch import Explainer
from tire_pipeline.mismatch.inference.evidence.likelihood import Likelihood
from tire_pipeline.mismatch.inference.sets import fitting


def test_a_fit_ends_where_steps_gain_near_one_size_of_the_misfit_only(tire, record, monkeypatch):
    """A step near one size undid what a step near another had gained: it went on for ever."""
    near, trials, at = [], [], Likelihood.at
    monkeypatch.setattr(Likelihood, "at", lambda self, weights: near.append(at(self, weights)) or near[-1])

    def every_step_gains(products, likelihood, changes, free):
        trials.append(1)
        assert len(trials) < 100
        return -float(len(trials)) if any(likelihood is each for each in near) else 0.0

    monkeypatch.setattr(fitting, "negative_log_posterior", every_step_gains)
    Explainer(without=all_but("friction_scale")).weigh(tire, record(3).iloc[:400])
    assert trials
