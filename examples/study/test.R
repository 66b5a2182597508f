# SPDX-License-Identifier: Apache-2.0
# Paired t-tests of rain against dry: Rscript test.R table.csv
table <- read.csv(commandArgs(trailingOnly = TRUE)[1])
measures <- setdiff(names(table), c("file", "participant", "condition", "run", "interval", "from_s", "to_s"))
header <- "%-9s %-22s %7s %7s %10s %20s %7s %3s %8s\n"
line <- "%-9s %-22s %7.3f %7.3f %10.4f %9.4f to %7.4f %7.2f %3.0f %8.1e\n"
cat(sprintf(header, "interval", "measure", "dry", "rain", "difference", "95 % interval", "t", "df", "p"))
for (interval in unique(table$interval)) {
  for (measure in measures) {
    of <- function(condition) {
      table[table$interval == interval & table$condition == condition, c("participant", measure)]
    }
    pairs <- merge(of("dry"), of("rain"), by = "participant")
    pairs <- pairs[complete.cases(pairs), ]
    if (nrow(pairs) < 2) next
    test <- t.test(pairs[[3]], pairs[[2]], paired = TRUE)
    cat(sprintf(line, interval, measure, mean(pairs[[2]]), mean(pairs[[3]]), test$estimate, test$conf.int[1],
                test$conf.int[2], test$statistic, test$parameter, test$p.value))
  }
}
