"""Data inside a page, written piece by piece."""

from __future__ import annotations

import base64
import json
import zlib

import pytest

from tire_pipeline.reporting.embedded import (
    data_element,
    data_element_in_pieces,
    json_list,
    packed_json,
    packed_json_list,
)


@pytest.mark.parametrize("count", [0, 1, 2, 3000])
def test_pieces_make_up_the_whole(count):
    rows = [[f"</script>&\u202e{i * 7919 % 1009}", i % 7 / 3, None, i % 2 == 0] for i in range(count)]
    pieces = list(packed_json_list(iter(rows)))
    packed = json.loads("".join(pieces))
    assert json.loads(zlib.decompress(base64.b64decode(packed, validate=True))) == rows
    assert zlib.decompress(base64.b64decode(packed)) == zlib.decompress(base64.b64decode(packed_json(rows)))
    whole = data_element("data", {"a<b": 1, "rows": rows, "packed": packed})
    entries = {"a<b": 1, "rows": json_list(iter(rows)), "packed": iter(pieces)}
    assert "".join(data_element_in_pieces("data", entries)) == whole
    assert whole.count("<") == 2
