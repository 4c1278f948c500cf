within HydraulicTestBench;
package Functions "Curves: pure, smooth functions the components call"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>A curve with a number or a corner in it lives here once, so that it can be tested alone: its limits, its slope at the
critical point and its sign.</p>
<p><b>Source:</b> thesis Section 3.2; each function names its equation.</p>
</html>"));
end Functions;
