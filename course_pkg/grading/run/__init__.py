"""One run of `course grade`: what it selects, where it runs, which results stay, and what it prints."""
