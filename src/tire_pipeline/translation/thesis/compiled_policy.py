"""Forward and backward pass of stable-baselines3's two 64-64 nets on one-hot bins, compiled.

A one-hot row has one 1 for each feature, so the first layer adds up d rows of its matrix instead of
multiplying d * n_bins numbers of which all but d are 0.
"""

from __future__ import annotations

import numpy as np
from numba import njit

HIDDEN_UNITS = 64
"""Nodes of both hidden layers: stable-baselines3's default."""


def net_shapes(n_features: int, n_bins: int, outputs: int) -> list[tuple[int, ...]]:
    """Shapes of weights (in, out) and biases of one net, in the order of the flat buffer."""
    first = n_features * n_bins
    return [
        (first, HIDDEN_UNITS),
        (HIDDEN_UNITS,),
        (HIDDEN_UNITS, HIDDEN_UNITS),
        (HIDDEN_UNITS,),
        (HIDDEN_UNITS, outputs),
        (outputs,),
    ]


@njit(cache=True, fastmath=True, inline="always")
def _tanh(x):  # type: ignore[no-untyped-def]
    """Rational approximation in float32 (Eigen's), within 3e-7 of tanh; unlike tanh it vectorises."""
    x = min(max(x, np.float32(-7.905311)), np.float32(7.905311))
    y = x * x
    p = np.float32(-2.76076847742355e-16)
    p = p * y + np.float32(2.00018790482477e-13)
    p = p * y + np.float32(-8.60467152213735e-11)
    p = p * y + np.float32(5.12229709037114e-08)
    p = p * y + np.float32(1.48572235717979e-05)
    p = p * y + np.float32(6.37261928875436e-04)
    p = p * y + np.float32(4.89352455891786e-03)
    q = np.float32(1.19825839466702e-06)
    q = q * y + np.float32(1.18534705686654e-04)
    q = q * y + np.float32(2.26843463243900e-03)
    q = q * y + np.float32(4.89352518554385e-03)
    return x * p / q


@njit(cache=True, fastmath=True, nogil=True)
def split_net(flat, start, inputs, outputs):  # type: ignore[no-untyped-def]
    """Give the six parts of one net as views into the flat buffer, and where the next one starts."""
    h = HIDDEN_UNITS
    a = start + inputs * h
    b = a + h
    c = b + h * h
    d = c + h
    e = d + h * outputs
    f = e + outputs
    return (
        flat[start:a].reshape(inputs, h),
        flat[a:b],
        flat[b:c].reshape(h, h),
        flat[c:d],
        flat[d:e].reshape(h, outputs),
        flat[e:f],
        f,
    )


@njit(cache=True, fastmath=True, nogil=True)
def _forward(states, n_bins, w1, b1, w2, b2, w3, b3, h1, h2, out):  # type: ignore[no-untyped-def]
    h = HIDDEN_UNITS
    for m in range(states.shape[0]):
        for j in range(h):
            h1[m, j] = b1[j]
        for f in range(states.shape[1]):
            row = f * n_bins + states[m, f]
            for j in range(h):
                h1[m, j] += w1[row, j]
        for j in range(h):
            h1[m, j] = _tanh(h1[m, j])
            h2[m, j] = b2[j]
        for i in range(h):
            x = h1[m, i]
            for j in range(h):
                h2[m, j] += x * w2[i, j]
        for j in range(h):
            h2[m, j] = _tanh(h2[m, j])
        for j in range(out.shape[1]):
            out[m, j] = b3[j]
        for i in range(h):
            x = h2[m, i]
            for j in range(out.shape[1]):
                out[m, j] += x * w3[i, j]


@njit(cache=True, fastmath=True, nogil=True)
def _backward(states, n_bins, w2, w3, h1, h2, dout, g1, gb1, g2, gb2, g3, gb3):  # type: ignore[no-untyped-def]
    """Add the gradient of the six parts, given that of the outputs."""
    h = HIDDEN_UNITS
    one = np.float32(1)
    d1 = np.empty(h, dtype=np.float32)
    d2 = np.empty(h, dtype=np.float32)
    for m in range(states.shape[0]):
        for j in range(dout.shape[1]):
            gb3[j] += dout[m, j]
        for i in range(h):
            x = h2[m, i]
            total = np.float32(0)
            for j in range(dout.shape[1]):
                g3[i, j] += x * dout[m, j]
                total += w3[i, j] * dout[m, j]
            d2[i] = total * (one - x * x)
        for j in range(h):
            gb2[j] += d2[j]
        for i in range(h):
            x = h1[m, i]
            total = np.float32(0)
            for j in range(h):
                g2[i, j] += x * d2[j]
                total += w2[i, j] * d2[j]
            d1[i] = total * (one - x * x)
        for j in range(h):
            gb1[j] += d1[j]
        for f in range(states.shape[1]):
            row = f * n_bins + states[m, f]
            for j in range(h):
                g1[row, j] += d1[j]


@njit(cache=True, fastmath=True, nogil=True)
def nets_forward(flat, states, n_bins, hidden, logs, shares, values):  # type: ignore[no-untyped-def]
    """Give log probabilities and probabilities (m, actions), values (m, 1), hidden layers (4, m, 64)."""
    inputs = states.shape[1] * n_bins
    actions = logs.shape[1]
    w1, b1, w2, b2, w3, b3, start = split_net(flat, 0, inputs, actions)
    _forward(states, n_bins, w1, b1, w2, b2, w3, b3, hidden[0], hidden[1], logs)
    w1, b1, w2, b2, w3, b3, start = split_net(flat, start, inputs, 1)
    _forward(states, n_bins, w1, b1, w2, b2, w3, b3, hidden[2], hidden[3], values)
    for m in range(logs.shape[0]):
        top = logs[m].max()
        total = np.float32(0)
        for j in range(actions):
            shares[m, j] = np.exp(logs[m, j] - top)
            total += shares[m, j]
        shift = top + np.log(total)
        for j in range(actions):
            logs[m, j] -= shift
            shares[m, j] /= total


@njit(cache=True, fastmath=True, nogil=True)
def sample(shares, uniform, actions):  # type: ignore[no-untyped-def]
    """Draw an action for each row of probabilities from one uniform number each."""
    for m in range(shares.shape[0]):
        total = 0.0
        drawn = shares.shape[1] - 1
        for j in range(shares.shape[1]):
            total += shares[m, j]
            if uniform[m] < total:
                drawn = j
                break
        actions[m] = drawn


@njit(cache=True, fastmath=True, nogil=True)
def pick(logs, shares, actions, chosen, entropy):  # type: ignore[no-untyped-def]
    """Log probability of each row's action, and each row's entropy."""
    for m in range(logs.shape[0]):
        chosen[m] = logs[m, actions[m]]
        total = np.float32(0)
        for j in range(logs.shape[1]):
            total -= shares[m, j] * logs[m, j]
        entropy[m] = total


@njit(cache=True, fastmath=True, nogil=True)
def nets_backward(  # type: ignore[no-untyped-def]
    flat, states, n_bins, hidden, logs, shares, actions, entropy, d_value, d_log, d_entropy, gradient
):
    """Add to ``gradient`` what the gradients of values, log probabilities and entropies make of it."""
    inputs = states.shape[1] * n_bins
    n_actions = logs.shape[1]
    d_out = np.empty_like(logs)
    for m in range(logs.shape[0]):
        for j in range(n_actions):
            p = shares[m, j]
            d_out[m, j] = -d_log[m] * p - d_entropy[m] * p * (logs[m, j] + entropy[m])
        d_out[m, actions[m]] += d_log[m]
    _, _, w2, _, w3, _, start = split_net(flat, 0, inputs, n_actions)
    g1, gb1, g2, gb2, g3, gb3, _ = split_net(gradient, 0, inputs, n_actions)
    _backward(states, n_bins, w2, w3, hidden[0], hidden[1], d_out, g1, gb1, g2, gb2, g3, gb3)
    _, _, w2, _, w3, _, _ = split_net(flat, start, inputs, 1)
    g1, gb1, g2, gb2, g3, gb3, _ = split_net(gradient, start, inputs, 1)
    d_values = d_value.reshape(-1, 1)
    _backward(states, n_bins, w2, w3, hidden[2], hidden[3], d_values, g1, gb1, g2, gb2, g3, gb3)


@njit(cache=True, fastmath=True, nogil=True)
def adam(values, slopes, first, second, rate, b1, b2, eps, taken):  # type: ignore[no-untyped-def]
    """Take one step of torch's Adam in place; ``taken`` counts the steps, this one included."""
    one = np.float32(1)
    m1, m2, tiny = np.float32(b1), np.float32(b2), np.float32(eps)
    size = np.float32(rate / (1 - b1**taken))
    root = np.float32(1 / np.sqrt(1 - b2**taken))
    for i in range(values.shape[0]):
        slope = slopes[i]
        m = m1 * first[i] + (one - m1) * slope
        v = m2 * second[i] + (one - m2) * slope * slope
        first[i] = m
        second[i] = v
        values[i] -= size * m / (np.sqrt(v) * root + tiny)
