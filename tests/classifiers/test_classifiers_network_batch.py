"""The batched training must do what one torch network after another does."""

import itertools

import numpy as np
import pytest
import torch
from torch import nn

from tire_pipeline.classifiers.methods.ann import network_probabilities
from tire_pipeline.classifiers.methods.network_batch import HIDDEN_LAYERS, LOSSES, TrainingSet, train_networks
from tire_pipeline.errors import DomainError


def torch_layers(data, *, seed, optimizer, loss, rate, decay, batch_size, epochs, n_classes):
    generator = torch.Generator().manual_seed(seed)
    sizes = [data.features.shape[1], *HIDDEN_LAYERS, n_classes]
    linear = []
    for a, b in itertools.pairwise(sizes):
        layer = nn.Linear(a, b)
        with torch.no_grad():
            layer.weight.copy_(torch.empty(a, b).uniform_(-(a**-0.5), a**-0.5, generator=generator).T)
            layer.bias.copy_(torch.empty(b).uniform_(-(a**-0.5), a**-0.5, generator=generator))
        linear.append(layer)
    network = nn.Sequential(linear[0], nn.ReLU(), linear[1], nn.ReLU(), linear[2], nn.ReLU(), linear[3])
    made = getattr(torch.optim, optimizer)(network.parameters(), lr=rate, weight_decay=decay)
    shuffle = np.random.default_rng([seed, 1])
    x = torch.as_tensor(data.features, dtype=torch.float32)
    y = torch.as_tensor(data.labels)
    for _ in range(epochs):
        for rows in torch.from_numpy(shuffle.permutation(len(x))).split(batch_size):
            scores = network(x[rows])
            if loss == "CrossEntropyLoss":
                value = nn.CrossEntropyLoss()(scores, y[rows])
            elif loss == "NLLLoss":
                value = nn.NLLLoss()(torch.log_softmax(scores, dim=1), y[rows])
            else:
                wanted = nn.functional.one_hot(y[rows], n_classes).float()
                value = nn.MSELoss()(torch.softmax(scores, dim=1), wanted)
            made.zero_grad()
            value.backward()
            made.step()
    return [(layer.weight.detach().numpy().T, layer.bias.detach().numpy()) for layer in linear]


@pytest.mark.parametrize("loss", LOSSES)
@pytest.mark.parametrize("optimizer", ["AdamW", "SGD", "RMSprop"])
def test_each_network_is_what_torch_trains_alone(binned, optimizer, loss):
    features, labels = binned
    numbers = np.unique(labels, return_inverse=True)[1]
    scaled = (features - features.mean(axis=0)) / features.std(axis=0)
    # other numbers of rows, batches that do not divide them, own rates and decays; the last two are alike
    sets = [TrainingSet(scaled[:n], numbers[:n]) for n in (150, 97, 128, 128)]
    rates, decays, seeds = [1e-3, 1e-4, 1e-3, 1e-3], [0.01, 0.0, 0.1, 0.1], [3, 4, 5, 6]
    trained = train_networks(
        sets,
        n_classes=4,
        learning_rates=rates,
        weight_decays=decays,
        seeds=seeds,
        optimizer=optimizer,
        loss=loss,
        batch_size=32,
        epochs=(1, 2),
    )
    assert set(trained) == {1, 2}
    for index, data in enumerate(sets):
        expected = torch_layers(
            data,
            seed=seeds[index],
            optimizer=optimizer,
            loss=loss,
            rate=rates[index],
            decay=decays[index],
            batch_size=32,
            epochs=2,
            n_classes=4,
        )
        np.testing.assert_allclose(
            network_probabilities(scaled, trained[2][index]),
            network_probabilities(scaled, expected),
            atol=2e-4,
        )


def test_unknown_loss_and_optimizer_are_refused(binned):
    data = [TrainingSet(binned[0], np.zeros(len(binned[0]), dtype=int))]
    options = {"n_classes": 2, "learning_rates": [1], "weight_decays": [0], "seeds": [0]}
    with pytest.raises(DomainError, match="NLLLoss"):
        train_networks(data, loss="Hinge", **options)
    with pytest.raises(DomainError, match="RMSprop"):
        train_networks(data, optimizer="Lion", **options)
