"""The type browser: service and message types, their fields, and the services and topics of each type."""
