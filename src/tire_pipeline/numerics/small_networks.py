"""torch for networks as small as these: optimisers that leave its compiler alone, and one thread."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TypeVar, cast

import torch

_Optimizer = TypeVar("_Optimizer", bound=torch.optim.Optimizer)


def uncompiled(kind: type[_Optimizer]) -> type[_Optimizer]:
    """The same optimiser, whose methods do not import torch's compiler.

    torch wraps them to tell its compiler to keep out, and imports it for that: each process that trains a
    network would spend two seconds on it. Nothing is compiled here.

    Parameters
    ----------
    kind : type
        ``torch.optim.Adam``, for example.

    Returns
    -------
    type
        A subclass that takes the same arguments and moves parameters by the same steps, to the last bit.

    Examples
    --------
    >>> weight = torch.nn.Parameter(torch.ones(1))
    >>> optimizer = uncompiled(torch.optim.SGD)([weight], lr=0.5)
    >>> weight.square().sum().backward()
    >>> optimizer.step()
    >>> weight.item()
    0.0
    """
    plain = {name: inspect.unwrap(getattr(kind, name)) for name in ("add_param_group", "zero_grad", "step")}
    own = type(kind.__name__, (kind,), {**plain, "step": torch.no_grad()(plain["step"])})
    return cast("type[_Optimizer]", own)


@contextmanager
def one_torch_thread() -> Iterator[None]:
    """Keep torch to one thread in the block: for networks this small, more only wait for each other.

    Examples
    --------
    >>> with one_torch_thread():
    ...     torch.get_num_threads()
    1
    """
    before = torch.get_num_threads()
    torch.set_num_threads(1)
    try:
        yield
    finally:
        torch.set_num_threads(before)
