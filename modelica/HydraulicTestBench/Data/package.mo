within HydraulicTestBench;
package Data "Parameter sets, each with its source"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Numbers only. In a set the values are in SI units; the tables they come from are in Hz, mm, mm2, dm3, N/mm, Ns/mm and
ms.</p>
<p><b>Source:</b> thesis Tables 4.5, 4.6 and 5.</p>
</html>"));
end Data;
