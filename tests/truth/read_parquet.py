"""Reads a table in Parquet with pyarrow and compares it with the same table in CSV.

    nocturne ephemeris --body all,Sirius --from 2026-01-01 --to 2027-01-01 --place Paris -o table.csv
    nocturne ephemeris --body all,Sirius --from 2026-01-01 --to 2027-01-01 --place Paris -o table.parquet
    python3 read_parquet.py table.csv table.parquet
"""

import csv
import sys

import pyarrow
import pyarrow.parquet

rows = list(csv.reader(open(sys.argv[1], newline="")))
columns = list(zip(*rows[1:]))
file = pyarrow.parquet.ParquetFile(sys.argv[2])
table = file.read()
table.validate(full=True)
assert table.column_names == rows[0], table.column_names
assert table.num_rows == len(rows) - 1, table.num_rows
for name, column in zip(rows[0], columns):
    for cell, value in zip(column, table[name].to_pylist()):
        if isinstance(value, float):
            # CSV has four decimals at least, and 0 for 360 degrees.
            half = 0.5 * 10.0 ** -len(cell.partition(".")[2])
            same = abs(float(cell) - value) <= half * 1.01 or cell == "0.000000000" and value > 359
        else:
            same = cell == (value or "")
        assert same, (name, cell, value)
print(f"pyarrow {pyarrow.__version__}: {table.num_rows} rows, {table.num_columns} columns, "
      f"{file.num_row_groups} row groups: the same")
