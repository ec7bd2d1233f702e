"""Tires that carry other loads than a car's are compared at theirs, and come out as car tires do."""

import numpy as np
import pytest

from tire_pipeline.tire_table.one_nominal_load import OWN_LOAD
from tire_pipeline.translation.curves.features import LOADS, encode
from tire_pipeline.translation.curves.load_scale import LoadScale
from tire_pipeline.translation.decode.scores_to_coefficients import COEFFICIENTS
from tire_pipeline.translation.translator import MixedModel

TRUCK = 4.0


def _times(table, factor):
    """The same tires, each carrying so many times as much."""
    back = LoadScale(1.0 / factor).scaled(table.assign(**{OWN_LOAD: 4500.0}))
    return back.drop(columns="load_factor").reset_index(drop=True)


@pytest.fixture(scope="module")
def cars(training):
    shared = training["tire_id"].map(training.groupby("tire_id")["category"].nunique()) > 1
    return training[shared | (np.arange(len(training)) % 4 == 0)].reset_index(drop=True)


@pytest.mark.parametrize(
    ("own", "factor"), [(4500.0, 1.0), (5200.0, 1.0), (4400.0, 1.0), (26_500.0, 2.0**2.5), (2250.0, 0.5)]
)
def test_the_factor_is_one_for_car_tires_and_follows_the_stated_loads(training, own, factor):
    assert LoadScale.fit(training.assign(**{OWN_LOAD: own})).factor == pytest.approx(factor)


def test_without_the_files_own_loads_the_factor_is_one(training):
    assert LoadScale.fit(training.drop(columns=OWN_LOAD, errors="ignore")).factor == 1.0


def test_scaled_tires_have_the_features_of_the_car_tires(cars):
    trucks = _times(cars, TRUCK)
    again = LoadScale(TRUCK).scaled(trucks)
    for group, features in encode(cars).items():
        np.testing.assert_allclose(encode(again)[group], features, rtol=1e-6, atol=1e-9)


def test_a_fleet_of_trucks_is_translated_as_the_same_fleet_of_cars(cars):
    cars = cars.assign(**{OWN_LOAD: 4500.0})
    trucks = _times(cars, TRUCK)
    sources = np.flatnonzero((cars["category"] != "D").to_numpy())[:5]
    results = [MixedModel().fit(t, target="D").translation(t.iloc[sources]) for t in (cars, trucks)]
    assert list(results[0].report["verdict"]) == list(results[1].report["verdict"])
    assert "translated" in set(results[0].report["verdict"])
    expected = [result.report["expected_rms_ratio"] for result in results]
    np.testing.assert_allclose(expected[1], expected[0], rtol=1e-3)
    moved = _times(results[0].table, TRUCK)[list(COEFFICIENTS)]
    np.testing.assert_allclose(results[1].table[list(COEFFICIENTS)], moved, rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(results[1].normal_load, TRUCK * LOADS)
    for name, band in results[1].bands.items():
        np.testing.assert_allclose(band.normal_load, TRUCK * LOADS)
        as_cars = TRUCK * results[0].bands[name].low
        np.testing.assert_allclose(band.low, as_cars, rtol=1e-2, atol=1e-2 * np.nanmax(np.abs(as_cars)))
