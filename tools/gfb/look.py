"""What pictures and pages share of their look; colours of pages stand in report/look.css, those of maps and curves in plot/colours.py."""

HEADER = "#2b4a6f"  # of the studio
FONT = "DejaVu Sans, Verdana, sans-serif"  # where the reader's machine has it
