"""The page in the browser of tools/studio: a case as a form and as text, its run, its results."""
