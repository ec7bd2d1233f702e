"""Each page with questions exists and has ten; what an answer says to type stands on its page."""

from __future__ import annotations

import re
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
QUESTIONS = yaml.safe_load((ROOT / "docs/questions.yml").read_text("utf-8"))


def test_ten_questions_with_answers_a_page():
    for page, questions in QUESTIONS.items():
        assert (ROOT / page).exists(), page
        assert len(questions) == 10, page
        assert len({question for question, _ in questions}) == 10, page
        assert all(question.endswith("?") and answer for question, answer in questions), page


def test_every_page_but_the_history_has_questions():
    pages = {str(path.relative_to(ROOT)) for path in (ROOT / "docs").rglob("*.md")}
    lists = {"docs/gallery/README.md"}  # a list of scripts
    assert {page for page in pages if not page.startswith("docs/history/")} - lists <= set(QUESTIONS)


def answers():
    """Each page, its text, and each question with its answer."""
    for page, questions in QUESTIONS.items():
        text = (ROOT / page).read_text("utf-8")
        for question, answer in questions:
            yield page, text, question, answer


def test_what_an_answer_says_to_type_stands_on_the_page():
    """Options, paths, parameters and names with an underscore stand in the page word for word."""
    for page, text, _, answer in answers():
        for word in re.findall(r"--[a-z-]+|\b\w+_\w+\b|\b[\w.]+/[\w./<>]+|\b[a-z_]+(?:\.[a-z_]+)+\b", answer):
            assert word.strip(".") in text, (page, word)


def test_each_number_in_an_answer_stands_on_the_page():
    """An answer that is older than its page shows by its figures."""
    for page, text, question, answer in answers():
        for number in re.findall(r"(?<![\w.])\d+(?:[.,]\d+)*(?![\w])", answer):
            assert re.search(rf"(?<![\d.,]){re.escape(number)}(?!\d)", text), (page, question, number)


def test_each_share_and_commit_in_an_answer_stands_on_the_page():
    """A number alone may stand on the page for another reason: a percentage and a commit hardly do."""
    for page, text, question, answer in answers():
        for word in re.findall(r"(?<![\w.])\d+(?:\.\d+)?%|\b(?=[a-f]*\d)[0-9a-f]{7,40}\b", answer):
            assert re.search(rf"(?<![\w.]){re.escape(word)}", text), (page, question, word)
