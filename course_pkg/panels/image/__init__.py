"""Pictures that nodes send, in the notebook."""
