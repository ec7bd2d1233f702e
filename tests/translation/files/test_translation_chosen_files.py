"""Files are chosen by path, folder or pattern before anything is fitted."""

import pytest

from tire_pipeline.errors import DomainError
from tire_pipeline.translation.files.chosen_files import choose_files
from tire_pipeline.translation.parameters import TranslateParameters

FILES = dict.fromkeys(["A/winter/1.tir", "A/2.tir", "B/winter.tir", "Bee/4.tir"], lambda: None)


@pytest.mark.parametrize(
    ("only", "chosen"),
    [
        ([], list(FILES)),
        (["A"], ["A/winter/1.tir", "A/2.tir"]),
        (["winter"], ["A/winter/1.tir"]),
        (["B*/*"], ["B/winter.tir", "Bee/4.tir"]),
        (["2.tir", "Bee"], ["A/2.tir", "Bee/4.tir"]),
    ],
)
def test_a_path_a_folder_or_a_pattern(only, chosen):
    assert list(choose_files(FILES, TranslateParameters(only=only))) == chosen


def test_no_more_than_the_trials_that_were_asked_for():
    assert list(choose_files(FILES, TranslateParameters(trials=2))) == list(FILES)[:2]


def test_what_matches_nothing_is_an_error_with_the_nearest_name():
    with pytest.raises(DomainError, match=r"only = 'Be' matches none of 4 files.*Bee"):
        choose_files(FILES, TranslateParameters(only=["A", "Be"]))
