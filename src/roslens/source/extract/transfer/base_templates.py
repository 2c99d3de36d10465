"""What the template parameters of the bases of an object stand for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.frame import Frame
from roslens.source.extract.ir.type_names import dotted

if TYPE_CHECKING:
    from roslens.source.extract.domain.abstract_value import Obj
    from roslens.source.extract.transfer.context import Context


def bind_bases(ctx: Context, thing: Obj) -> None:
    """Note what the classes of an object give their bases as template arguments: ``class A : public Base<String>``."""
    for one in ctx.index.chain(thing.defined) if thing.defined is not None else ():
        arguments = one.what.base_templates
        if not arguments:
            continue
        name = one.what.qualified_name
        outer, ctx.state.frame = ctx.state.frame, Frame(one.path, name, thing)
        ctx.state.frame.templates.update(thing.templates_of(name))
        for written, given in zip(one.what.bases, arguments, strict=False):
            base = ctx.index.class_of(written, one.path, name.rpartition(".")[0])
            if base is not None and given:
                names = base.what.templates
                bound = dict(zip(names, (_whole(ctx, each) for each in given), strict=False))
                thing.base_templates.setdefault(base.what.qualified_name, bound)
        ctx.state.frame = outer


def _whole(ctx: Context, written: str) -> str:
    """Return a template argument as it is meant where it is written: elsewhere its name may mean another class."""
    meant = ctx.calls.template(written)
    plain = dotted(meant)
    defined = ctx.index.class_of(plain, ctx.state.frame.path, ctx.state.frame.scope) if plain.isidentifier() else None
    return meant if defined is None else defined.what.qualified_name
