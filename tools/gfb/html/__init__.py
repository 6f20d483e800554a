"""The manual as HTML pages."""
