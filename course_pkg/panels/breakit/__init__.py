"""The lab Break it: cases with a real fault, which the student diagnoses from the symptom."""
