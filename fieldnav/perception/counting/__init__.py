"""Counting the rows that pass while a camera moves sideways."""
