"""One name, one thing: no class, constant or module of this project is taken for another."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterable
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest

import tire_pipeline
from tire_pipeline.channels import (
    FORCE_CHANNELS,
    FORCE_OF_SLIP,
    MOMENT_CHANNELS,
    PLANE_FORCES,
    SLIP_AND_LOAD,
    SLIP_OF_FORCE,
    TANGENTIAL_FORCES,
)

pytestmark = pytest.mark.slow
ROOT = Path(tire_pipeline.__file__).parent

SEALED = ("concealed.second.", "concealed.open_world.")
"""Simulators that are sealed by the hash of their source: their names stay as they are."""

SEALED_RIG = "concealed.brush_rig."

USUAL = {"T", "LOG", "Array"}
"""Names that each module gives to its own type variable, to its own logger, and to an array of numbers."""

METAPHORS = {
    "wish",
    "caution",
    "cautious",
    "doubt",
    "doubts",
    "doubtful",
    "bury",
    "shelf",
    "hand",
    "hands",
    "ledger",
    "signpost",
    "cure",
    "heard",
    "wander",
    "bridged",
}


@cache
def _modules() -> dict[str, ast.Module]:
    every = {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): ast.parse(path.read_text(encoding="utf-8"))
        for path in sorted(ROOT.rglob("*.py"))
        if path.parent.name != "__pycache__"  # derivatives that are generated at first use
    }
    return {name: module for name, module in every.items() if "__pycache__" not in name}


@cache
def _nodes(module: ast.Module) -> tuple[ast.AST, ...]:
    """All nodes of a module's tree, which several tests look at."""
    return tuple(ast.walk(module))


def _written() -> dict[str, ast.Module]:
    """All but the sealed simulators."""
    return {name: module for name, module in _modules().items() if not name.startswith(SEALED)}


def _classes(module: ast.Module) -> list[str]:
    return [each.name.lstrip("_") for each in module.body if isinstance(each, ast.ClassDef)]


def _constants(module: ast.Module) -> list[str]:
    assigned = [each for each in module.body if isinstance(each, ast.Assign)]
    annotated = [each for each in module.body if isinstance(each, ast.AnnAssign) and each.value]
    targets = [target for each in assigned for target in each.targets] + [each.target for each in annotated]
    names = [each.id for target in targets for each in ast.walk(target) if isinstance(each, ast.Name)]
    return [name for name in names if name.isupper() and name.lstrip("_") not in USUAL]


def _types(module: ast.Module) -> list[str]:
    """Types that have got a name, such as ``Read = Callable[[], bytes]``."""
    named = [each for each in module.body if isinstance(each, ast.Assign) and len(each.targets) == 1]
    names = [each.targets[0].id.lstrip("_") for each in named if isinstance(each.targets[0], ast.Name)]
    return [name for name in names if name[:1].isupper() and not name.isupper() and name not in USUAL]


def _twice(names: dict[str, list[str]]) -> set[str]:
    places = defaultdict(set)
    for module, own in names.items():
        for name in own:
            places[name].add(module)
    return {name for name, found in places.items() if len(found) > 1}


def _a_letter_apart(first: str, second: str) -> bool:
    short, long = sorted((first, second), key=len)
    if len(short) == len(long):
        return sum(a != b for a, b in zip(short, long, strict=True)) == 1
    return len(long) - len(short) == 1 and any(long[:i] + long[i + 1 :] == short for i in range(len(long)))


def test_no_two_classes_of_one_name_nor_one_of_a_sealed_simulator():
    sealed = [each for name in _modules() if name.startswith(SEALED) for each in _classes(_modules()[name])]
    assert sealed
    written = {name: _classes(module) for name, module in _written().items()}
    assert _twice({**written, "sealed": sealed}) == set()


def test_no_two_types_of_one_name_nor_one_of_a_class():
    """Outside of ``mismatch``, whose own types are another matter."""
    modules = {name: each for name, each in _written().items() if not name.startswith("mismatch.")}
    names = {name: [*_types(each), *_classes(each)] for name, each in modules.items()}
    assert {"Read", "StoredFiles", "FilesToMake"} <= set(names["files.read_later"])
    assert _twice(names) == set()


def _constants_of(modules: dict[str, ast.Module]) -> dict[str, list[str]]:
    """Without their underscores, which make no other name."""
    return {name: [each.lstrip("_") for each in _constants(module)] for name, module in modules.items()}


def test_no_two_constants_of_one_name():
    """Whatever package they are in."""
    assert _twice(_constants_of(_written())) == set()


def test_no_constant_has_the_name_of_one_of_a_sealed_simulator():
    every = _constants_of(_modules())
    simulators = (*SEALED, SEALED_RIG)
    sealed = [each for name, found in every.items() if name.startswith(simulators) for each in found]
    others = {name: found for name, found in every.items() if not name.startswith(simulators)}
    assert sealed
    assert _twice({**others, "sealed": sealed}) == set()


DIFFERENT_WORDS = {
    ("fit", "jit"),
    ("pipeline", "pipelines"),
    ("read", "real"),
    ("recording", "recordings"),
    ("tir", "tire"),
}
"""Pairs of modules that nobody takes for each other. ``pipeline`` and ``pipelines`` are Kedro's;
``recordings`` reads files, and ``mismatch/recording`` prepares one for its explanation."""


def _names_of_modules(modules: Iterable[str]) -> set[str]:
    """Modules and the folders that they stand in."""
    return {part for name in modules for part in name.split(".")} - {"__init__", "__main__"}


def test_no_two_modules_a_letter_apart():
    names = _names_of_modules(_written())
    pairs = {pair for pair in combinations(sorted(names), 2) if _a_letter_apart(*pair)}
    assert pairs == DIFFERENT_WORDS


def test_no_metaphors():
    found = set()
    for module in _written().values():
        named = {each.name for each in _nodes(module) if isinstance(each, ast.FunctionDef | ast.ClassDef)}
        named |= {each.id for each in _nodes(module) if isinstance(each, ast.Name)}
        named |= {each.attr for each in _nodes(module) if isinstance(each, ast.Attribute)}
        named |= {each.arg or "" for each in _nodes(module) if isinstance(each, ast.arg | ast.keyword)}
        found |= {name for name in named if set(name.lower().split("_")) & METAPHORS}
    assert found == set()


@cache
def _tests() -> dict[str, ast.Module]:
    here = Path(__file__).parent
    return {
        path.relative_to(here).as_posix(): ast.parse(path.read_text(encoding="utf-8"))
        for path in here.rglob("*.py")
    }


def test_tests_import_public_names_only():
    found = {
        f"{path}: {alias.name}"
        for path, module in _tests().items()
        for each in _nodes(module)
        if isinstance(each, ast.ImportFrom) and (each.module or "").startswith("tire_pipeline")
        for alias in each.names
        if alias.name.startswith("_") and not alias.name.startswith("__")
    }
    assert found == set()


SHOWN = {"_replace", "_fields", "_asdict", "_repr_html_", "_exit", "_make_api_call"}
"""Names of the standard library and of notebooks that are public in spite of the underscore, and the one
place through which aiobotocore sends everything: there a write is killed."""


def _private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__") and name not in SHOWN


def _reached(module: ast.Module) -> set[str]:
    """Private members of other objects that a module reads, or puts something in place of."""
    found = set()
    for each in _nodes(module):
        if isinstance(each, ast.Attribute) and not (
            isinstance(each.value, ast.Name) and each.value.id in ("self", "cls")
        ):
            found.add(each.attr)
        called = each.func if isinstance(each, ast.Call) else None
        if (isinstance(called, ast.Attribute) and called.attr == "setattr") or (
            isinstance(called, ast.Name) and called.id == "setattr"
        ):
            texts = [str(a.value) for a in each.args if isinstance(a, ast.Constant)]
            found |= {text.rpartition(".")[2] for text in texts}
    return {name for name in found if _private(name)}


def test_tests_reach_for_no_private_member():
    found = {path: _reached(module) for path, module in _tests().items()}
    assert {path: names for path, names in found.items() if names} == {}


def _written_out(module: ast.Module, names: set[str]) -> bool:
    """Whether a list of these names stands in the module, whatever else is in it."""
    lists = [each for each in _nodes(module) if isinstance(each, ast.Tuple | ast.List | ast.Set)]
    return any(names <= {e.value for e in each.elts if isinstance(e, ast.Constant)} for each in lists)


def test_channels_of_an_operating_point_are_listed_once():
    found = [name for name, module in _written().items() if _written_out(module, set(SLIP_AND_LOAD))]
    assert found == ["channels"]


FORCE_LISTS = [set(names) for names in (FORCE_CHANNELS, MOMENT_CHANNELS, PLANE_FORCES, TANGENTIAL_FORCES)]


def _list_of_forces(node: ast.AST) -> bool:
    """Whether this is one of the lists of forces, in whatever order."""
    if not isinstance(node, ast.Tuple | ast.List | ast.Set):
        return False
    names = [each.value for each in node.elts if isinstance(each, ast.Constant)]
    return len(names) == len(node.elts) and set(names) in FORCE_LISTS


def _force_beside_slip(pair: list[ast.expr | None]) -> bool:
    names = [each.value for each in pair if isinstance(each, ast.Constant)]
    return all(sum(name in known for name in names) == 1 for known in (SLIP_OF_FORCE, FORCE_OF_SLIP))


def _map_of_force_and_slip(node: ast.AST) -> bool:
    """Whether this says of two forces or more which slip they belong to, or chooses the slip by the force."""
    if isinstance(node, ast.Dict):
        pairs = [list(pair) for pair in zip(node.keys, node.values, strict=True)]
        panels = [(key, value) for key, value in pairs if isinstance(value, ast.Tuple | ast.List)]
        pairs += [[key, *value.elts] for key, value in panels if ast.unparse(key).strip("'") in SLIP_OF_FORCE]
    elif isinstance(node, ast.Tuple | ast.List):
        pairs = [list(each.elts) for each in node.elts if isinstance(each, ast.Tuple | ast.List)]
    elif isinstance(node, ast.IfExp):
        chosen = {each.value for each in (node.body, node.orelse) if isinstance(each, ast.Constant)}
        asked = {each.value for each in ast.walk(node.test) if isinstance(each, ast.Constant)}
        return chosen == set(FORCE_OF_SLIP) and bool(asked & set(FORCE_CHANNELS))
    else:
        return False
    return sum(map(_force_beside_slip, pairs)) > 1


def test_forces_and_their_slips_are_listed_once():
    modules = {name: each for name, each in _written().items() if not name.startswith(SEALED_RIG)}
    lists = [name for name, each in modules.items() if any(map(_list_of_forces, _nodes(each)))]
    maps = [name for name, each in modules.items() if any(map(_map_of_force_and_slip, _nodes(each)))]
    assert set(lists) == {"channels"}
    assert maps == ["channels"] * len(maps)


def test_a_second_map_of_forces_would_be_found():
    seconds = [
        "{'fy': 'slip_angle', 'fx': 'slip_ratio'}",
        "{'fy': ('slip_angle', 'deg'), 'fx': ('slip_ratio', '')}",
        "(('slip_angle', 'fy'), ('slip_ratio', 'fx'))",
        "'slip_angle' if name == 'fy' else 'slip_ratio'",
    ]
    found = [any(map(_map_of_force_and_slip, ast.walk(ast.parse(second)))) for second in seconds]
    assert found == [True] * len(seconds)


TOPICS = {"docs", "notebooks", "object_storage", "supply_chain", "viz"}
"""Folders of tests that belong to no single folder of the package."""


WHOLE_EXPLANATIONS = {"mismatch/rates", "mismatch/real_recordings"}
"""Folders of tests that take every part of an explanation together."""


def test_a_file_of_tests_bears_the_name_of_its_folder_and_the_folder_that_of_what_it_tests():
    tests = Path(__file__).parent
    files = [path.relative_to(tests) for path in tests.glob("*/**/test_*.py")]
    assert [str(file) for file in files if not file.stem.startswith(f"test_{file.parts[0]}")] == []
    parts = {path.stem for path in ROOT.iterdir()}
    assert {file.parts[0] for file in files} - parts == TOPICS
    inner = {file.parent.as_posix() for file in files if len(file.parts) > 2}
    parts = {path.relative_to(ROOT).with_suffix("").as_posix() for path in ROOT.glob("*/*")}
    assert inner - parts == WHOLE_EXPLANATIONS


@pytest.mark.parametrize("listed", ["ci_only.txt", "known_misses.txt"])
def test_tests_that_are_listed_are_there(listed):
    tests = Path(__file__).parent
    for line in (tests / listed).read_text(encoding="utf-8").splitlines():
        if line.startswith("tests/"):
            file, _, case = line.partition("::")
            test = f"def {case.partition('[')[0]}(" if case else ""
            assert test in (tests.parent / file).read_text(encoding="utf-8"), line


def test_files_that_are_begun_first_are_there():
    tests = Path(__file__).parent
    listed = re.findall(
        r'^    "(\S+/test_\w+\.py)",$', (tests / "conftest.py").read_text("utf-8"), re.MULTILINE
    )
    assert listed
    assert [file for file in listed if not (tests / file).is_file()] == []


KEDROS = {"__init__", "__main__", "cli", "settings"}
"""Modules that Kedro wants where they are."""


def test_the_page_on_architecture_names_each_folder_and_module_at_the_top():
    page = (Path(__file__).parents[1] / "docs" / "reference" / "architecture.md").read_text(encoding="utf-8")
    there = {f"{path.parent.name}/" for path in ROOT.glob("*/__init__.py")}
    there |= {path.name for path in ROOT.glob("*.py") if path.stem not in KEDROS}
    assert there - set(page.translate(str.maketrans(":`", "  ")).split()) == set()


def test_the_first_letter_of_a_sentence_is_made_large_in_one_place():
    by_hand = [
        name
        for name, module in _written().items()
        for each in _nodes(module)
        if isinstance(each, ast.Call) and re.search(r"\[:1\]\.(upper|lower)\(\)$", ast.unparse(each))
    ]
    assert set(by_hand) == {"pages.first_letter"}
