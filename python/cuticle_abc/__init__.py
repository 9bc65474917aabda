"""Alembic files for the command line, by alembic3d (wheels of the Alembic library with its own Python bindings)."""
