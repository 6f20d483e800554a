"""The pictures of tools/plot: films, foils, strips, histories."""
