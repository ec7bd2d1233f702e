"""docs/explanation/fleet.md says what the code does."""

from pathlib import Path

from tire_pipeline.fleet.describe import regimes_markdown

DOCS = Path(__file__).parents[2] / "docs"


def test_the_table_of_regimes_is_the_codes() -> None:
    assert regimes_markdown() in (DOCS / "explanation" / "fleet.md").read_text()
    assert (DOCS / "figures" / "fleet_one_tire.svg").exists()
