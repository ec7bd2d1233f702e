import numpy as np
import pytest
from sklearn.datasets import make_classification


@pytest.fixture(scope="session")
def binned():
    """400 rows of 8 features in 10 bins, four unbalanced categories."""
    features, numbers = make_classification(
        n_samples=400,
        n_features=8,
        n_informative=6,
        n_classes=4,
        weights=[0.5, 0.3, 0.15, 0.05],
        n_clusters_per_class=1,
        class_sep=1.3,
        random_state=0,
    )
    low, high = features.min(axis=0), features.max(axis=0)
    bins = np.minimum((features - low) / (high - low) * 10 // 1, 9)
    return bins, np.array(list("ABCD"))[numbers]


@pytest.fixture(scope="session")
def parts(binned):
    order = np.random.default_rng(0).permutation(len(binned[1]))
    return order[:300], order[300:]
