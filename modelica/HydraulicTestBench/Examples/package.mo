within HydraulicTestBench;
package Examples "Models to run and look at"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Each is complete: no input is open, the experiment is set.</p>
<p><b>Source:</b> thesis Chapters 2 and 4 for the tests and parameters.</p>
</html>"));
end Examples;
