"""Captions of frame and title block in Russian (рамка и основная надпись по-русски)."""

from planmethod.note.wording.sheet_model import FrameWording

FRAME = FrameWording(
    captions={
        "change": "Изм.",
        "changed": "Лист",
        "document": "№ докум.",
        "signature": "Подп.",
        "date": "Дата",
        "approver": "Утв.",
        "norm_control": "Н.контр.",
        "t_control": "Т.контр.",
        "checker": "Пров.",
        "author": "Разраб.",
        "letter": "Лит.",
        "mass": "Масса",
        "scale": "Масштаб",
        "sheet": "Лист",
        "sheets": "Листов",
        "inventory": "Инв. № подл.",
        "signed": "Подп. и дата",
        "inventory_instead": "Взам. инв. №",
        "inventory_copy": "Инв. № дубл.",
        "first_use": "Перв. примен.",
        "reference": "Справ. №",
    },
    copied="Копировал",
    format="Формат {paper}",
    paper="А",
    portrait="{paper} (книжная)",
)
