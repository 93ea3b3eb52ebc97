"""The version, which the metadata of an installed package would take a node long to look up."""

VERSION = "0.1.0"
