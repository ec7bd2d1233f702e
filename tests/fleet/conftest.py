import pytest

from tire_pipeline.fleet import Fleet, FleetSettings, make_fleet


@pytest.fixture(scope="session")
def small_settings() -> FleetSettings:
    return FleetSettings(seed=7, files=400, hidden_tires=4, tuning_tires=3, paired_tires=2)


@pytest.fixture(scope="session")
def small_fleet(small_settings: FleetSettings) -> Fleet:
    return make_fleet(small_settings)
