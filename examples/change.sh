#!/bin/sh
# Write the example workspace into a folder, as a repository in which one change is not committed yet: change.sh FOLDER
set -eu
here=$(dirname "$0")
rm -rf "$1"
mkdir -p "$1"
cp -R "$here/workspace/." "$1"
rm -rf "$1/.roslens"
git -C "$1" init -q
git -C "$1" add -A
git -C "$1" -c user.name=roslens -c user.email=roslens@example.org commit -q -m "the rover as it was"
cp -R "$here/change/." "$1"
