"""The panel "Break it": the student finds the cause of a real fault from its symptom."""
