"""Optimisers that leave torch's compiler alone move parameters as torch's own do."""

import pytest
import torch

from tire_pipeline.numerics.small_networks import one_torch_thread, uncompiled

pytestmark = pytest.mark.slow


def _trained(kind, options):
    torch.manual_seed(0)
    weights = torch.nn.Parameter(torch.randn(30))
    optimizer = kind([{"params": [weights], "lr": 1e-2}], **options)
    for _ in range(20):
        optimizer.zero_grad()
        ((weights - 1.0) ** 4).sum().backward()
        optimizer.step()
    return weights.detach().numpy().tobytes()


@pytest.mark.parametrize(
    ("kind", "options"),
    [
        (torch.optim.Adam, {}),
        (torch.optim.Adam, {"fused": True}),
        (torch.optim.AdamW, {"fused": True}),
        (torch.optim.SGD, {"fused": True}),
        (torch.optim.RMSprop, {}),
    ],
)
def test_the_same_steps_to_the_last_bit(kind, options):
    own = _trained(uncompiled(kind), options)
    assert own == _trained(kind, options)
    assert own == _trained(uncompiled(kind), options)  # torch has wrapped its own class by now


def test_one_thread_in_the_block_and_as_many_as_before_after_it():
    def failing_block():
        with one_torch_thread():
            raise ValueError(torch.get_num_threads())

    before = torch.get_num_threads()
    torch.set_num_threads(3)
    try:
        with pytest.raises(ValueError, match=r"^1$"):
            failing_block()
        assert torch.get_num_threads() == 3
    finally:
        torch.set_num_threads(before)
