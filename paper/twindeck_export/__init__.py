"""Tables of a study as one workbook of Excel (.xlsx)."""
