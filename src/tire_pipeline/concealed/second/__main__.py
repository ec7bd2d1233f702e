"""Print the content hash of each sealed part: `python -m tire_pipeline.concealed.second`."""

from pathlib import Path

from tire_pipeline.concealed.second.content import content_hash

if __name__ == "__main__":
    for folder in ("second", "open_world"):
        print(folder, content_hash(Path(__file__).parents[1] / folder))
