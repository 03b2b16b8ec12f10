"""What sources print beside the exact and the read value (проверка источников)."""
