"""Accounts of subjects, from which notes, protocols, results and sheets are made (изложение)."""
