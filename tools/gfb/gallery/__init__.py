"""The pages of tools/gallery: results of [Gu2020] beside gfb's."""
