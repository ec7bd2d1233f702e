"""kedro-viz, opened on the story and read from left to right; and as one page without a server."""
