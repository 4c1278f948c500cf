within HydraulicTestBench;
package Icons "Drawings the classes share"
  annotation(Documentation(info="<html>
<p>Plain drawings, one per kind of class. Connectors carry their own.</p>
<p><b>Source:</b> this library.</p>
</html>"));
end Icons;
