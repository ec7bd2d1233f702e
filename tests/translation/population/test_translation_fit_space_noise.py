import warnings

import numpy as np

from tire_pipeline.translation.population.fit_space import noise_covariance


def test_files_that_are_nearly_alike_bring_no_warning_with_a_source_path(rng):
    """A user who translates 64 files saw eight of scikit-learn's."""
    apart = rng.standard_normal((64, 4)) * [1.0, 1e-9, 1e-9, 1e-3]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = noise_covariance(apart, np.repeat(np.arange(16), 4))
    assert found is not None
    assert np.isfinite(found).all()
