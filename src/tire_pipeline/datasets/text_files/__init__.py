"""Pages, texts, and folders of them."""
