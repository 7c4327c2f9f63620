"""Parts of a page as HTML: the Markdown, the code cells and the figures of a notebook."""
