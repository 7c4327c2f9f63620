"""The checks, one module a chapter, and beside each module the answers that it is held to."""
