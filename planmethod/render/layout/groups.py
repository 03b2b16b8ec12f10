"""Groups of a sheet's blocks (группы блоков): what stays together, in reading order."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, TypeAlias

from msgspec import Struct

from planmethod.render.layout.block import Alternatives, Block

GAP = 9.0
"""Least white between two blocks, mm."""

CLEAR = 3.0
"""Least white between a block and a box that must stay free, mm."""

EDGE = 5.0
"""Least white between a block and the frame, mm."""

Arrange: TypeAlias = Literal["free", "row", "column", "columns"]

Placed: TypeAlias = tuple[Block, complex]
"""A block in its chosen layout, and its upper left corner."""


class LayoutItem(Struct, frozen=True):
    """A block to be packed; a ``text`` is joined with neighbouring texts."""

    block: Block
    text: bool = False

    @property
    def alternatives(self) -> tuple[Block, ...]:
        """All layouts of the block."""
        return self.block.blocks if isinstance(self.block, Alternatives) else (self.block,)

    @property
    def grows(self) -> bool:
        """True if larger layouts are at larger scales."""
        return isinstance(self.block, Alternatives) and self.block.grows


class Group(Struct, frozen=True):
    """Parts and groups that stay together (группа блоков).

    ``arrange`` is their arrangement: free, side by side, one under another; of a whole sheet also
    in columns.
    """

    members: tuple[LayoutItem | Group, ...]
    arrange: Arrange = "free"

    def inner(self) -> Group:
        """Return only the innermost groups, freely arranged."""
        members: list[LayoutItem | Group] = []
        for member in self.members:
            if isinstance(member, LayoutItem):
                members.append(member)
            elif any(isinstance(one, Group) for one in member.members):
                members += member.inner().members
            else:
                members.append(Group(member.members))
        return Group(tuple(members))

    def flat(self) -> Group:
        """Return the parts without groups."""
        return Group(tuple(self.parts()))

    def parts(self) -> Iterator[LayoutItem]:
        """Yield the parts in reading order."""
        for member in self.members:
            if isinstance(member, LayoutItem):
                yield member
            else:
                yield from member.parts()
