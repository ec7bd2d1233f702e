"""The page that shows the thesis' tables and figures beside ours."""
