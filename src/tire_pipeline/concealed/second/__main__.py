"""Print the content hash: `python -m tire_pipeline.concealed.second`."""

from tire_pipeline.concealed.second.content import content_hash

if __name__ == "__main__":
    print(content_hash())
