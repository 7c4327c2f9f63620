"""The checks, one module or package a chapter, and beside each the answers that it is held to."""
