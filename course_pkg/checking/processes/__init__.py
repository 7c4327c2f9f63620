"""The two processes of a check: the check client in the kernel, and the check runner."""
