within HydraulicTestBenchMSL;
package Examples "Models of both libraries together"
  extends Modelica.Icons.ExamplesPackage;
  annotation(Documentation(info="<html>
<p>Each is complete: no input is open, the experiment is set.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Examples;
