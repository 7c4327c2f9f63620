"""The lab: cases in which something is really broken, to be diagnosed from the symptom."""
