"""The timeline panel: who did what when, and who waited for whom."""
