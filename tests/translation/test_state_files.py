from tire_pipeline.state_files import prefixed, without_prefix


def test_prefixes_nest():
    state = {**prefixed("a", {"x": 1}), **prefixed("ab", {"x": 2})}
    assert without_prefix("a", state) == {"x": 1}
    assert without_prefix("ab", state) == {"x": 2}
