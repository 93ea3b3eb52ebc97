"""The version; a lookup in the metadata of the package would slow the start of a node."""

VERSION = "0.1.0"
