# SPDX-License-Identifier: Apache-2.0
# A header with its // comments as doxygen's ///. The block below the licence becomes the file's own description; a
# comment behind a declaration belongs to it. What /// says already is left as it is. Where `folder` is set, each
# header is written below it by its own path, otherwise all to standard output.
BEGIN { to = "/dev/stdout" }
FNR == 1 && folder {
  close(to)
  to = folder "/" FILENAME
}
function escaped(comment) {
  gsub(/[\\@<>#&%]/, "\\\\&", comment)
  return comment
}
/^ *\/\/ SPDX-License-Identifier:/ { print "/// \\file" > to; head = 1; next }
head && /^ *\/\/( |$)/ {
  sub(/^ *\/\/ ?/, "")
  print "/// " escaped($0) > to
  next
}
{ head = 0 }
/^ *\/\/( |$)/ {
  match($0, /^ *\/\//)
  print substr($0, 1, RLENGTH) "/" escaped(substr($0, RLENGTH + 1)) > to
  next
}
/^ *(\/\/\/|\}|#)/ { print > to; next }
match($0, /[;,{)] +\/\/ /) {
  print substr($0, 1, RSTART) " ///< " escaped(substr($0, RSTART + RLENGTH)) > to
  next
}
{ print > to }
