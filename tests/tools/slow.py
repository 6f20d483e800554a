"""Tests that take so long that they run only where they are asked for: `tools/test --long`, or `..._test.py -k slow`."""

import sys
import unittest

slow = unittest.skipUnless("slow" in sys.argv, "takes long: -k slow")  # names of such tests begin with test_slow
