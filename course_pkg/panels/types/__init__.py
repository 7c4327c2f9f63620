"""The type browser: service and message types, what they are made of, and who offers them."""
