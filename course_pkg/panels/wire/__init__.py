"""The wire view: the bytes of a real call, explained one by one."""
