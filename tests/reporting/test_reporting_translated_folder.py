"""What a run of ``translate`` says last."""

from __future__ import annotations

import html

import pandas as pd
import pytest

from tire_pipeline.reporting.translation.translated_folder_page import translate_page
from tire_pipeline.reporting.translation.translated_rows import SHOWN_VERDICTS
from tire_pipeline.translation.parameters import TranslateParameters

HEADINGS = ("Every file", "What the verdicts mean", "How it was done")
REPORT = pd.DataFrame(
    {
        "file": ["A/a.tir", "A/b.tir", "mine/c.tir"],
        "source": ["A", "A", "mine"],
        "verdict": ["translated", "refused", "translated"],
        "reason": ["", "its version is not 5.x: fit 5.2", ""],
        "expected_rms_ratio": [0.1, float("nan"), 0.3],
    }
)


def outcome(**parameters):
    demonstration = ["A/a.tir", "A/b.tir", "B/d.tir"]
    asked = TranslateParameters(**parameters)
    _, said = translate_page([REPORT], {}, pd.DataFrame(), demonstration, asked, "D")
    return said


def test_the_users_own_files_come_first():
    assert outcome()[:2] == [
        "Your own file: 1 translated to D, 0 refused.",
        "The demonstration fleet's 2 files: 1 translated to D, 1 refused.",
    ]


def test_why_files_were_refused_and_which_are_the_targets_own_is_said():
    """Fifteen of thirty files were refused, and the page said why only where each was clicked."""
    why = ["no physical tire found: shape", "no physical tire found: lateral friction", "cannot be read: x"]
    report = pd.DataFrame(
        {
            "file": list("abcde"),
            "source": ["A", "A", "A", "D", "A"],
            "verdict": ["refused"] * 3 + ["already unbiased"] * 2,
            "reason": [*why, "it is the target's own", "nothing beyond 5%"],
            "expected_rms_ratio": float("nan"),
        }
    )
    _, said = translate_page([report], {}, pd.DataFrame(), [], TranslateParameters(), "D")
    counted = "0 translated to D, 3 refused, 1 already unbiased, 1 measured by D itself"
    assert said == [
        f"Your own 5 files: {counted}.",
        "Refused: no physical tire found (2); cannot be read (1). "
        "The page gives the whole reason for each file.",
    ]


def test_where_no_file_was_refused_no_reason_is_given():
    translated = REPORT[REPORT["verdict"] == "translated"]
    _, said = translate_page([translated], {}, pd.DataFrame(), [], TranslateParameters(), "D")
    assert not any("Refused" in line for line in said)


def test_files_that_were_asked_for_are_not_called_all():
    own, demonstration, asked = outcome(only=["A", "mine"])[:3]
    assert "Your own file asked for" in own
    assert "2 files asked for" in demonstration
    assert "only A, mine" in asked
    assert "shows these files only" in asked
    assert "stay in 07_model_output/translated" in asked
    assert "at most 3 files" in outcome(trials=3)[2]


@pytest.mark.parametrize(
    ("farthest", "said"),
    [
        (1.0, "none beyond distance 1, the edge of the training data"),
        (2.5, "none beyond distance 2.5, as asked for (1 is the edge of the training data)"),
    ],
)
def test_how_far_from_the_training_data_was_translated_is_said(farthest, said):
    asked = TranslateParameters(farthest=farthest)
    page, _ = translate_page([REPORT], {}, pd.DataFrame(), [], asked, "D")
    assert said in html.unescape(str(page))


def test_the_head_of_the_page_says_what_came_out_and_the_end_how():
    """There were eleven paragraphs above the files."""
    page, said = translate_page([REPORT], {}, pd.DataFrame(), ["A/a.tir"], TranslateParameters(), "D")
    text = str(page)
    head, _, rest = text.partition('<div class="main">')[2].partition("</div>")
    assert [line for line in said if line not in html.unescape(head)] == []
    assert head.count("<p>") == len(said) <= 4
    files, meaning, method = (rest.index(f"<h2>{name}") for name in HEADINGS)
    assert files < meaning < method
    for verdict in SHOWN_VERDICTS:
        assert f"<td>{verdict}</td>" in rest[meaning:method]
