"""A configuration of a workspace by what the user names: a launch file with arguments, packages, or everything."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError
from roslens.model.source import Role

if TYPE_CHECKING:
    from roslens.model.configuration import Configuration, Unresolved
    from roslens.source.extract.facts.launched import Launch
    from roslens.source.extract.facts.launched import Unresolved as Missed
    from roslens.source.extract.workspace.workspace_facts import WorkspaceFacts
    from roslens.source.progress import Progress
    from roslens.source.run_inputs import Seen
    from roslens.source.settings import SourceSettings


class GraphSource:
    """The workspace below some folder, from which configurations are made; a context manager."""

    def __init__(
        self,
        path: str,
        settings: SourceSettings,
        hinted_in: str,
        environment: Mapping[str, str],
        *,
        cache: Path | None = None,
        jobs: int = 1,
        progress: Progress | None = None,
        elsewhere: bool = False,
        seen: Seen | None = None,
    ) -> None:
        """Find the packages of a workspace.

        Args:
            path: folder of it.
            settings: how files are classified, macros, hints.
            hinted_in: the file with the hints.
            environment: variables that conditions of manifests see.
            cache: the file in which is kept what was learned of files; None keeps nothing.
            jobs: worker processes; 0 means one per processor.
            progress: who watches files being read.
            elsewhere: whether the files stand at another place than those that the cache knows by path.
            seen: the workspace and its files, where they are known.

        Raises:
            UsageError: there is no such folder.
        """
        import time

        from roslens.cli.graph.reads import Reads
        from roslens.source.extract.facts.noted_files import NotedFiles
        from roslens.source.extract.workspace.known_launches import KnownLaunches
        from roslens.source.extract.workspace.workspace_facts import WorkspaceFacts
        from roslens.source.known_manifests import KnownManifests
        from roslens.source.workspace.find import find_workspace
        from roslens.store.cache import Cache
        from roslens.store.content_cache import ContentCache

        self.settings = settings
        self.hinted_in = hinted_in
        self._environment = environment
        self._evaluated: dict[tuple[str, tuple[tuple[str, str], ...]], Launch] = {}
        now_s = time.time()
        self.cache = (ContentCache if elsewhere else Cache).open(cache, now_s=now_s)
        if seen is None:
            manifests = KnownManifests(self.cache)
            workspace = find_workspace([path], settings.workspace, read=manifests.read)
            manifests.keep()
        else:
            workspace = seen.workspace
        self.root = Path(workspace.root)
        self.failures = workspace.failures
        self._hidden = workspace.hidden
        self.paths = frozenset(file.path for found in workspace.packages for file in found.files)
        self.facts: WorkspaceFacts = WorkspaceFacts(
            workspace, settings, cache=self.cache, now_s=now_s, jobs=jobs, progress=progress,
            inventory=None if seen is None else seen.inventory,
        )  # fmt: skip
        self.reads = Reads(NotedFiles(self.facts.files))
        self.launches = KnownLaunches(self.cache, self.facts.files)

    def __enter__(self) -> GraphSource:
        """Return the source itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Keep what was learned, and close the cache."""
        self.facts.keep()
        self.launches.keep()
        self.cache.close()

    @property
    def is_lasting(self) -> bool:
        """Whether the next run would find the same in the same files."""
        return self.launches.is_lasting and self.facts.is_lasting

    def launched(self, launch: str, arguments: Mapping[str, str]) -> Configuration:
        """Return what a launch file comes to.

        Raises:
            UsageError: there is no such file.
        """
        import msgspec

        from roslens.cli.graph.graph_missed import reported_by_file
        from roslens.source.extract.catalogue.catalogue import known_node
        from roslens.source.extract.configuration.assemble import assemble

        path, result = self.evaluated(launch, arguments)
        started = sorted({one.package.known for one in result.nodes if one.package.known})
        facts = self.facts.of(result.generation)
        missed = reported_by_file(
            one for name in started for one in (*facts.missed_in_code(name), *facts.never_called(name))
        )
        result = msgspec.structs.replace(result, unresolved=(*result.unresolved, *missed))
        given = "".join(f" {name}:={value}" for name, value in self.meant(launch, arguments)[1].items())
        return assemble(
            result, facts, title=path + given, known=known_node, files=self.reads.files,
            hints=self.settings.graph.hints, hinted_in=self.hinted_in,
        )  # fmt: skip

    def evaluated(self, launch: str, arguments: Mapping[str, str]) -> tuple[str, Launch]:
        """Return the path of a launch file and what it comes to by itself.

        Raises:
            UsageError: there is no such file.
        """
        from roslens.source.extract.launch.launch_ros1 import evaluate_ros1
        from roslens.source.extract.launch.launch_ros2 import evaluate_ros2
        from roslens.source.extract.launch.launch_version import launch_version

        launch, arguments = self.meant(launch, arguments)
        path = self._launch_file(launch)
        key = (path, tuple(sorted(arguments.items())))
        if key not in self._evaluated:
            content = self.facts.files.content(path) or b""
            version = launch_version(path, content, self.facts.versions(self.facts.package_names.get(path, "")))
            evaluate = evaluate_ros1 if version == "ros1" else evaluate_ros2
            environment = self.settings.workspace.environment
            self._evaluated[key] = self.launches.launch(
                (version, *key), environment, lambda files, variables: evaluate(path, files, arguments, variables)
            )
        return path, self._evaluated[key]

    def packages(self, names: Sequence[str]) -> tuple[Configuration, ...]:
        """Return all that the builds of packages make: a configuration for each generation of ROS.

        Raises:
            UsageError: the workspace has no package of that name.
        """
        from roslens.cli.graph.graph_missed import reported_once, with_roles
        from roslens.source.extract.catalogue.catalogue import known_node
        from roslens.source.extract.configuration.assemble import assemble, targets_started

        known = [package.name for package in self.facts.packages]
        for name in names:
            if name not in known:
                raise _no_package(name, known)
        found = []
        for generation in ("ros1", "ros2"):
            facts = self.facts.of(generation)
            chosen = [
                one.name
                for one in facts.packages
                if (one.name in names or not names) and generation in facts.versions(one.name)
            ]
            nodes = [node for name in chosen for node in targets_started(name, facts, generation).nodes]
            if not nodes:
                continue
            from roslens.source.extract.facts.launched import Launch

            missed = [
                *reported_once(one for name in chosen for one in facts.missed(name)),
                *(one for name in chosen for one in facts.missed_in_code(name)),
                *(() if names or generation != self._mostly() else self._left_out()),
            ]
            title = ", ".join(chosen) if names else f"all packages of {generation.upper().replace('ROS', 'ROS ')}"
            started = Launch(generation, tuple(nodes), unresolved=tuple(missed))
            made = assemble(
                started, facts, title=title, known=known_node, files=self.reads.files,
                by_launch=False, hints=self.settings.graph.hints, hinted_in=self.hinted_in,
            )  # fmt: skip
            found.append(with_roles(made, facts.roles))
        return tuple(one for one in found if one.nodes)

    def unstarted_beside(self, launched: Configuration) -> tuple[Configuration, ...]:
        """Return what code of the packages that a launch file starts makes that no known program starts."""
        names = sorted({node.package for node in launched.nodes if self.facts.has(node.package)})
        near = (launched, *(self.packages(names) if names else ()))
        if not names or not any(one.nodes for one in self.unstarted(names, near)):
            return ()
        found = self.unstarted(names, (launched, *self.packages(())))
        return tuple(one for one in found if one.generation == launched.generation and one.nodes)

    def unstarted(self, names: Sequence[str], started: Sequence[Configuration] = ()) -> tuple[Configuration, ...]:
        """Return what code of packages makes that no known program starts: a configuration for each generation of ROS.

        Of packages whose builds make no node it has what was not understood of their code.

        Args:
            names: of packages; none means all.
            started: what is shown elsewhere; by default what the builds of all packages make.
        """
        from roslens.source.extract.configuration.unstarted import places_shown, unstarted, unstarted_configuration

        started = started or self.packages(())
        wanted = set(names) or {*self.facts.package_names.values()}
        found = []
        for generation in ("ros1", "ros2"):
            facts = self.facts.of(generation)
            targets = (one for package in facts.packages for one in facts.targets(package.name))
            # Code for one version alone is shown where it is started, whatever its unit was taken for.
            own = [one for one in started if one.generation == generation or not facts.file_versions]
            made_here = [one for one in facts.made() if one.generation == generation]
            loose = unstarted(made_here, places_shown(own), facts.package_names, targets)
            shown = any(one.generation == generation for one in started)
            reported = {one.name for one in facts.packages if shown and generation in facts.versions(one.name)}
            beside = sorted(wanted - reported)
            # Where nothing else of the workspace is shown, folders that are left out of it are named here.
            left_out = () if names or started or generation != self._mostly() else tuple(self._left_out())
            missed = self._missed_beside(beside, generation, left_out)
            in_code = (one for name in beside for one in facts.missed_in_code(name))
            code = {one.evidence.path for one in (*left_out, *in_code)}
            made = unstarted_configuration(
                generation, [one for one in loose if one.package in wanted], facts,
                hints=self.settings.graph.hints, hinted_in=self.hinted_in, roles=facts.roles, missed=missed,
            )  # fmt: skip
            if made.nodes or any(one.proof.path in code for one in made.unresolved):
                found.append(made)
        return tuple(found)

    def _missed_beside(self, packages: Sequence[str], generation: str, left_out: Sequence[Missed]) -> list[Unresolved]:
        """Return what was not understood of packages whose builds make no node of a version of ROS."""
        from roslens.cli.graph.graph_missed import reported_once
        from roslens.model.configuration import Unresolved
        from roslens.source.extract.parameters.assemble_proof import launch_proof

        facts = self.facts.of(generation)
        files = facts.file_versions
        found = [Unresolved(one.text, launch_proof(one.evidence), one.reason) for one in left_out]
        for name in packages:
            versions = facts.versions(name) or (self._mostly(),)
            for one in (*reported_once(facts.missed(name)), *facts.missed_in_code(name)):
                path = one.evidence.path
                if files[path] == generation if path in files else generation in versions:
                    role = facts.roles.get(path, "")
                    proof = launch_proof(one.evidence)
                    found.append(
                        Unresolved(one.text, proof, one.reason, opens=one.opens, role=role, missing=one.missing)
                    )
        return found

    def _left_out(self) -> Iterator[Missed]:
        """Yield the folders with packages that a marker leaves out of the workspace."""
        from roslens.source.extract.facts.launched import Unresolved as Missed
        from roslens.source.extract.facts.node_facts import Evidence

        for path, marker in self._hidden:
            yield Missed(path, Evidence(f"{path}/{marker}", 1), "its packages are left out because of this file")

    def _mostly(self) -> str:
        ros1 = ["ros1" in self.facts.versions(one.name) for one in self.facts.packages]
        return "ros1" if sum(ros1) * 2 > len(ros1) else "ros2"

    def first_launch_files(self) -> tuple[str, ...]:
        """Return the paths of the launch files that start something and that no other of the users' own includes."""
        found: dict[str, int] = {}
        included: set[str] = set()
        for package in self.facts.packages:
            for path in self.facts.launch_files(package.name):
                if self.facts.role(path) is Role.OWN:
                    launch = self.evaluated(f"{self.root}/{path}", {})[1]
                    found[path] = len(launch.nodes)
                    included |= {other for other in launch.included if other != path}
        return tuple(sorted(path for path, nodes in found.items() if nodes and path not in included))

    def launch_files(self) -> Iterator[str]:
        """Yield the launch files of the workspace as PACKAGE/FILE."""
        for package in self.facts.packages:
            for path in self.facts.launch_files(package.name):
                yield f"{package.name}/{path.rpartition('/')[2]}"

    def names_launch_file(self, launch: str) -> bool:
        """Return whether the workspace has a launch file of that name."""
        return self._found(self.meant(launch, {})[0]) is not None

    def meant(self, launch: str, arguments: Mapping[str, str]) -> tuple[str, dict[str, str]]:
        """Return the launch file and the arguments of a configuration that ``roslens.toml`` declares, or those given.

        Arguments that are given too win over declared ones.
        """
        declared = self.settings.graph.configurations.get(launch)
        return (launch, dict(arguments)) if declared is None else (declared.launch, {**declared.given(), **arguments})

    def _launch_file(self, launch: str) -> str:
        found = self._found(launch)
        if found is None:
            raise self.no_launch_file(launch)
        return found

    def _found(self, launch: str) -> str | None:
        package, slash, name = launch.partition("/")
        if slash and self.facts.has(package):
            fit = [path for path in self.facts.launch_files(package) if path.endswith(f"/{name}")]
            if fit:
                return min(fit, key=lambda path: ("/launch/" not in f"/{path}", len(path), path))
        folder = self.facts.files.package(package) if slash else None
        inside = [self.root / folder / name] if folder is not None else []
        for start in (*inside, Path(launch), self.root / launch):
            if start.is_file():
                resolved = start.resolve()
                if not resolved.is_relative_to(self.root):
                    raise UsageError(
                        f'"{launch}" is outside of the workspace "{self.root}"',
                        expected="a launch file in it",
                        advice="Give the folder of the workspace as PATH",
                    )
                return resolved.relative_to(self.root).as_posix()
        return None

    def no_launch_file(self, launch: str) -> UsageError:
        """Return the error with the launch file that may have been meant."""
        import difflib

        near = difflib.get_close_matches(launch, list(self.launch_files()), 1, 0.4)
        return UsageError(
            f'no launch file "{launch}"',
            expected="PACKAGE/FILE or a path",
            advice=f'Did you mean "{near[0]}"?' if near else "",
        )


def _no_package(name: str, known: Sequence[str]) -> UsageError:
    import difflib

    near = difflib.get_close_matches(name, known, 1)
    shown = ", ".join(known[:8]) + (" …" if len(known) > 8 else "")
    advice = f'Did you mean "{near[0]}"?' if near else ""
    return UsageError(f'no package "{name}"', expected=f"one of {shown}", advice=advice)


def arguments_of(words: Sequence[str]) -> dict[str, str]:
    """Return arguments of a launch file by name, from words like ``name:=value``.

    Raises:
        UsageError: a word is none.
    """
    found = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator or not name:
            raise UsageError(f'--arg "{word}"', expected="name:=value")
        found[name] = value
    return found
