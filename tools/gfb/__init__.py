"""The Python behind tools/bench, tools/gallery, tools/plot and tools/manual, and behind the tests that run gfb."""
